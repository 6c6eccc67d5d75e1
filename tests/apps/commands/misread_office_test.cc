// The office that an independent renderer photographed, with its readings read wrongly: `luxfit fit` names the mistake.
// All fits share the stages before the fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/apps/office_copy.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using Fields = std::vector<std::string>;  // id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx

class MisreadOffice : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    office_ = new support::OfficeCopy;
    right_ = office_->Read("office/luxmeter.csv");
  }
  static void TearDownTestSuite() { delete office_; }

  static json Fit(const std::function<void(Fields&)>& mistake, int status) {
    office_->Write("office/luxmeter.csv", right_);
    office_->ChangeRows("office/luxmeter.csv", [&](Fields& fields) {
      mistake(fields);
      return true;
    });
    return office_->ResultOf("fit", status);
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

  static support::OfficeCopy* office_;
  static std::string right_;
};
support::OfficeCopy* MisreadOffice::office_ = nullptr;
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
