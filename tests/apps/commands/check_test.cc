// `luxfit check` after `luxfit fit` on readings of an isotropic point in no room: E = Phi / (4 pi) h / r^3.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/apps/program.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr char kSession[] = R"(name = "point"

[states]
A = { A = 1.0 }
half = { A = 0.5 }

[[luminaire]]
id = "A"
photometry = "isotropic"
shape = "point"

[luxmeter]
readings = "luxmeter.csv"
fit = ["F*"]
)";

class Check : public testing::Test {
 protected:
  // What the readings that check are multiplied by.
  using Error = std::function<double(const std::string& id, const std::string& state)>;

  int Fit(const Error& error, int places_that_check = 5) const {
    std::string table = "id,x_m,y_m,z_m,nx,ny,nz,state,lux\n";
    int n = 0;
    for (const double x : {-1.0, -0.5, 0.1, 0.6, 1.1}) {
      for (const double y : {-0.9, -0.3, 0.2, 0.7, 1.2}) {
        const std::string id = fmt::format("F{}", ++n);
        // Half a percent up and down, so that readings and model do not agree to the last digit.
        table += Row(id, x, y, "A", n % 2 == 0 ? 1.005 : 0.995);
      }
    }
    for (const char* state : {"A", "half"}) {
      for (int k = 1; k <= places_that_check; ++k) {
        const std::string id = fmt::format("L{}", k);
        table += Row(id, 0.3 * k - 0.8, 0.45 - 0.2 * k, state, error(id, state));
      }
    }
    folder_.Write("luxmeter.csv", table);
    folder_.Write("session.toml", kSession);
    return support::RunProgram("fit '" + folder_.Path("session.toml") + "' -o '" + folder_.Path("out") + "'")
        .status;
  }

  support::ProgramRun Run(const std::string& flags = "") const {
    return support::RunProgram("check '" + folder_.Path("out") + "' " + flags);
  }

  static std::string Row(const std::string& id, double x, double y, const std::string& state, double factor) {
    const double to_x = x - 0.2, to_y = y + 0.1, height = 2;
    const double r = std::sqrt(to_x * to_x + to_y * to_y + height * height);
    const double lux =
        (state == "half" ? 0.5 : 1) * 1200 / (4 * 3.14159265358979323846) * height / (r * r * r);
    return fmt::format("{},{},{},0,0,0,1,{},{:.6f}\n", id, x, y, state, lux * factor);
  }

  TempFolder folder_;
};

TEST_F(Check, ReadingsThatAgreeAreSaidToAgree) {
  ASSERT_EQ(Fit([](const std::string&, const std::string&) { return 1.0; }), 0);
  const support::ProgramRun run = Run();
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.output, HasSubstr("95 % interval"));
  EXPECT_THAT(run.output, HasSubstr("no reading disagrees"));
  EXPECT_THAT(run.output, HasSubstr("no more than chance"));
}

TEST_F(Check, WhereNothingChecksErrorsAreUnknown) {
  ASSERT_EQ(Fit([](const std::string&, const std::string&) { return 1.0; }, 0), 0);
  const json result = json::parse(folder_.Read("out/result.json"));
  EXPECT_EQ(result["summary"]["readings_checked"], 0);
  for (const char* key : {"mean_abs_error_lx", "mean_abs_error_percent", "max_abs_error_percent"}) {
    ASSERT_TRUE(result["summary"].contains(key)) << key;
    EXPECT_TRUE(result["summary"][key].is_null()) << key;
  }
  const json& all = result["check"]["table"][0];
  EXPECT_EQ(all["readings"], 0);
  for (const char* key : {"mean_lx", "mean_error_percent", "mean_abs_error_lx", "mean_abs_error_percent",
                          "max_abs_error_percent"})
    EXPECT_TRUE(all[key].is_null()) << key;
  const support::ProgramRun run = Run();
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_THAT(run.output,
              HasSubstr("checked 0 readings: mean error - lx = - % of the mean reading, largest - %"));
}

TEST_F(Check, OneWrongReadingIsNamedWithARemedy) {
  ASSERT_EQ(Fit([](const std::string& id, const std::string& state) {
              return id == "L3" && state == "half" ? 0.7 : 1.0;
            }),
            1);
  EXPECT_EQ(json::parse(folder_.Read("out/result.json"))["status_because"],
            json::array({"reading_disagrees"}));
  const std::string text = Run().output;
  EXPECT_THAT(text, HasSubstr("L3 in state half disagrees: 30."));
  EXPECT_THAT(text, HasSubstr("below its prediction"));
  EXPECT_THAT(text, HasSubstr("remedy: the meter may have been shaded"));
  EXPECT_THAT(text, Not(HasSubstr("L3 in state A")));
}

// The readings contradict the fit as a whole, so that its exit status is not 0.
TEST_F(Check, ACommonErrorIsAScale) {
  ASSERT_EQ(Fit([](const std::string&, const std::string&) { return 1.2; }), 1);
  const json result = json::parse(folder_.Read("out/result.json"));
  EXPECT_EQ(result["status"], "undetermined");
  EXPECT_EQ(result["status_because"], json::array({"readings_contradict", "readings_off_alike"}));
  EXPECT_THAT(support::RunProgram("explain '" + folder_.Path("out") + "'").output,
              testing::StartsWith("undetermined because of readings_contradict, readings_off_alike\n"));
  const std::string text = Run().output;
  EXPECT_THAT(text, HasSubstr("all readings are off alike: 20."));
  EXPECT_THAT(text, HasSubstr("the absolute scale is off"));
  EXPECT_THAT(text, HasSubstr("no reading disagrees"));
}

TEST_F(Check, TheTableHasMetersAllAndTheSubset) {
  ASSERT_EQ(Fit([](const std::string& id, const std::string&) { return id == "L1" ? 1.02 : 1.0; }), 0);
  const support::ProgramRun run = Run("--subset 'L*@half' --json");
  ASSERT_EQ(run.status, 0);
  const json check = json::parse(run.output)["check"];
  ASSERT_EQ(check["table"].size(), 7u);  // L1 to L5, all, the subset
  EXPECT_EQ(check["table"][0]["of"], "L1");
  EXPECT_EQ(check["table"][0]["readings"], 2);
  // 2 % high against a prediction that is right to the fit's own half percent.
  EXPECT_NEAR(check["table"][0]["mean_abs_error_percent"].get<double>(), 100 * 0.02 / 1.02, 0.5);
  EXPECT_EQ(check["table"][5]["of"], "all");
  EXPECT_EQ(check["table"][5]["readings"], 10);
  EXPECT_EQ(check["table"][6]["of"], "L*@half");
  EXPECT_EQ(check["table"][6]["readings"], 5);
}

TEST_F(Check, ASubsetOfNothingIsRefused) {
  ASSERT_EQ(Fit([](const std::string&, const std::string&) { return 1.0; }), 0);
  const support::ProgramRun run = Run("--subset X9");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.output, HasSubstr("--subset: expected a pattern that matches a reading that checks"));
}

TEST_F(Check, IntervalsHoldTheModelErrorToo) {
  ASSERT_EQ(Fit([](const std::string&, const std::string&) { return 1.0; }), 0);
  const json result = json::parse(Run("--json").output);
  for (const json& r : result["luxmeter"]) {
    const double predicted = r["predicted_lx"], low = r["interval95_lx"][0], high = r["interval95_lx"][1];
    EXPECT_NEAR(high - low, 2 * 1.96 * r["prediction_sigma_lx"].get<double>(), 1e-9 * predicted);
    EXPECT_GE(r["prediction_sigma_lx"].get<double>(), r["sigma_lx"].get<double>());
  }
}

}  // namespace
}  // namespace luxfit
