// The office that an independent renderer photographed, in daylight that falls by 30 % from state to state (office_variants): what
// the program says of it, and what it keeps for the next run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/office_copy.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Daylight, WhatIsLeftOfItIsFittedAndSaid) {
  const support::OfficeCopy office;
  const std::string make = std::string("'") + LUXFIT_OFFICE_VARIANTS + "' '" + support::kOfficeFolder +
                           "' dusk_by_state '" + office.Path("office") + "'";
  ASSERT_EQ(std::system(make.c_str()), 0);
  const json result = office.ResultOf("fit", 0);
  EXPECT_EQ(result["warnings"][0]["code"], "ambient_changed");
  EXPECT_THAT(result["choices"].dump(), HasSubstr("\"a share for each of 3 states\""));
  const json fit = office.Json("out/stages/fit.json");
  const json& parameters = fit["parameters"];
  EXPECT_EQ(std::count_if(parameters.begin(), parameters.end(),
                          [](const json& p) { return p.dump().find("ambient_share") != std::string::npos; }),
            4);  // one a state, as the state of all off has one
  // The next run reads what this one kept.
  const json again = office.ResultOf("fit", 0);
  EXPECT_EQ(again["luminaires"], result["luminaires"]);
  EXPECT_EQ(again["warnings"], result["warnings"]);
}

}  // namespace
}  // namespace luxfit
