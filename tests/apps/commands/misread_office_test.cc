// The office that an independent renderer photographed, with its readings read wrongly: `luxfit fit` names the mistake.
// All fits share the stages before the fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/apps/program.h"
#include "tests/support/office_truth.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using Fields = std::vector<std::string>;  // id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx

class MisreadOffice : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    std::filesystem::copy(support::kOfficeFolder, folder_->Path("office"),
                          std::filesystem::copy_options::recursive);
    right_ = folder_->Read("office/luxmeter.csv");
  }
  static void TearDownTestSuite() { delete folder_; }

  static json Fit(const std::function<void(Fields&)>& mistake, int status) {
    std::istringstream rows(right_);
    std::string row, table;
    std::getline(rows, row);
    table = row + "\n";
    while (std::getline(rows, row)) {
      Fields fields;
      std::istringstream of_row(row);
      for (std::string field; std::getline(of_row, field, ',');) fields.push_back(field);
      mistake(fields);
      for (size_t i = 0; i < fields.size(); ++i) table += fields[i] + (i + 1 < fields.size() ? "," : "\n");
    }
    folder_->Write("office/luxmeter.csv", table);
    const support::ProgramRun run = support::RunProgram(
        fmt::format("fit '{}' -o '{}'", folder_->Path("office/session.toml"), folder_->Path("out")));
    EXPECT_EQ(run.status, status) << run.output;
    return json::parse(folder_->Read("out/result.json"));
  }

  // One explanation, which leaves no more than the office's readings are off by (1.4 % rms).
  static void ExpectExplained(const json& result, const std::string& as_if) {
    ASSERT_TRUE(result["check"].contains("explained")) << result["warnings"].dump(1);
    const json& by = result["check"]["explained"]["by"];
    ASSERT_EQ(by.size(), 1u) << by.dump(1);
    EXPECT_THAT(by[0]["as_if"].get<std::string>(), HasSubstr(as_if));
    EXPECT_LT(by[0]["rms_percent"].get<double>(), 2);
    EXPECT_THAT(result["status_because"].dump(), HasSubstr("readings_as_if"));
  }

  static TempFolder* folder_;
  static std::string right_;
};
TempFolder* MisreadOffice::folder_ = nullptr;
std::string MisreadOffice::right_;

TEST_F(MisreadOffice, RightReadingsAreLeftAlone) {
  EXPECT_FALSE(Fit([](Fields&) {}, 0)["check"].contains("explained"));
}

TEST_F(MisreadOffice, ExchangedAxes) {
  ExpectExplained(Fit([](Fields& f) { std::swap(f[1], f[2]); }, 1), "x and y were exchanged");
}

TEST_F(MisreadOffice, TheScaleInFootCandles) {
  const json result = Fit(
      [](Fields& f) {
        if (f[0] == "L3" && f[7] == "all") f[8] = fmt::format("{}", std::stod(f[8]) / 10.764);
      },
      1);
  ExpectExplained(result,
                  "the reading that sets the scale, L3@all, was 10.7 times too low, as in foot-candles");
}

TEST_F(MisreadOffice, PlacesInCentimetres) {
  const json result = Fit(
      [](Fields& f) {
        for (const size_t i : {1, 2, 3}) f[i] = fmt::format("{}", 100 * std::stod(f[i]));
      },
      1);
  ExpectExplained(result, "their places were in cm");
}

}  // namespace
}  // namespace luxfit
