#include "apps/text/formats/former_keys.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace luxfit {
namespace {

using nlohmann::json;

TEST(FormerKeys, StandBesideThePresentOnesAtAnyDepth) {
  json result = {{"luxmeter", {{{"id", "L1"}, {"measured_lx", 300.5}, {"interval95_lx", {1, 2}}}}},
                 {"summary", {{"mean_abs_error_lx", nullptr}}}};
  AddFormerKeys(result);
  EXPECT_EQ(result, (json{{"luxmeter",
                           {{{"id", "L1"},
                             {"measured_lx", 300.5},
                             {"measured_lux", 300.5},
                             {"interval95_lx", {1, 2}},
                             {"interval95_lux", {1, 2}}}}},
                          {"summary", {{"mean_abs_error_lx", nullptr}, {"mean_abs_error_lux", nullptr}}}}));
}

TEST(FormerKeys, WholeKeysHaveFormerNamesToo) {
  json finding = {{"fix", "tilt it"}, {"prefix", 1}, {"relative_sigma_prior", 0.02}};
  AddFormerKeys(finding);
  EXPECT_EQ(finding, (json{{"fix", "tilt it"},
                           {"mend", "tilt it"},
                           {"prefix", 1},
                           {"relative_sigma_prior", 0.02},
                           {"relative_sigma_beforehand", 0.02}}));
}

TEST(FormerKeys, ResultsOfTheFormerVersionAreReadByThePresentOnes) {
  json result = {{"predicted_lux", 4}, {"sigma_lux", 1}, {"sigma_lx", 2}, {"lux", 3}, {"flux_lm", 5}};
  AddPresentKeys(result);
  EXPECT_EQ(result, (json{{"predicted_lux", 4},
                          {"predicted_lx", 4},
                          {"sigma_lux", 1},
                          {"sigma_lx", 2},
                          {"lux", 3},
                          {"flux_lm", 5}}));
}

}  // namespace
}  // namespace luxfit
