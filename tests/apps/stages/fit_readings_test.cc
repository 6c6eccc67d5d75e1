// `luxfit fit` on readings without photos and without a room, their truth from closed forms.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/apps/program.h"
#include "tests/support/closed_forms.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using nlohmann::json;
using support::kPi;

class FitOfReadings : public testing::Test {
 protected:
  // 13 x 13 places over 3.6 m x 3.6 m at the origin, facing up; the sensor's name by its row where asked for.
  void WriteReadings(const std::function<double(const Eigen::Vector3d&, int row)>& lux, int sensors = 0) {
    std::string csv = "id,x_m,y_m,z_m,nx,ny,nz,state,lux";
    csv += sensors > 0 ? ",sensor\n" : "\n";
    for (int i = 0; i < 13; ++i) {
      for (int j = 0; j < 13; ++j) {
        const Eigen::Vector3d at(0.3 * (i - 6), 0.3 * (j - 6), 0);
        csv += fmt::format("P{}_{},{},{},0,0,0,1,on,{:.6f}", i, j, at.x(), at.y(), lux(at, j));
        csv += sensors > 0 ? fmt::format(",s{}\n", j % sensors) : "\n";
      }
    }
    folder_.Write("luxmeter.csv", csv);
  }

  void WriteSession(const std::string& luminaire) {
    folder_.Write("session.toml",
                  "name = \"bench\"\n\n[states]\non = { A = 1 }\n\n[[luminaire]]\nid = \"A\"\n" + luminaire +
                      "\n[luxmeter]\nreadings = \"luxmeter.csv\"\nfit = [\"*\"]\n");
  }

  json Fit(const std::string& out = "out", const std::string& options = "") {
    const support::ProgramRun run = support::RunProgram("fit '" + folder_.Path("session.toml") + "' -o '" +
                                                        folder_.Path(out) + "' " + options);
    EXPECT_EQ(run.status, 0) << run.output;
    return json::parse(folder_.Read(out + "/result.json"));
  }

  static Eigen::Vector3d PositionOf(const json& luminaire) {
    const json& p = luminaire["position_m"];
    return {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()};
  }

  TempFolder folder_;
};

// Intensities of a batwing, linear between 0, 30, 60 and 90 degrees, cd.
const std::vector<double> kBatwingCd{100, 200, 260, 0};
double BatwingCd(double gamma_rad) {
  const double at = std::min(2.999999, gamma_rad / (kPi / 6));
  const size_t i = static_cast<size_t>(at);
  return kBatwingCd[i] + (at - static_cast<double>(i)) * (kBatwingCd[i + 1] - kBatwingCd[i]);
}
// 2 pi int I sin: of I = a + b g over [g0, g1] it is 2 pi [-(a + b g) cos g + b sin g].
double BatwingFluxLm() {
  double flux = 0;
  for (size_t i = 0; i + 1 < kBatwingCd.size(); ++i) {
    const double g0 = static_cast<double>(i) * kPi / 6, g1 = g0 + kPi / 6;
    const double b = (kBatwingCd[i + 1] - kBatwingCd[i]) / (g1 - g0);
    flux += 2 * kPi *
            (-kBatwingCd[i + 1] * std::cos(g1) + b * std::sin(g1) + kBatwingCd[i] * std::cos(g0) -
             b * std::sin(g0));
  }
  return flux;
}
const Eigen::Vector3d kLamp(0.2, -0.1, 1.5);
double BatwingLux(const Eigen::Vector3d& at) {
  const Eigen::Vector3d to = kLamp - at;
  const double cosine = to.z() / to.norm();
  return BatwingCd(std::acos(cosine)) * cosine / to.squaredNorm();
}

TEST_F(FitOfReadings, GivenTable) {
  WriteReadings([](const Eigen::Vector3d& at, int) { return BatwingLux(at); });
  // Any unit: they are scaled to the flux.
  WriteSession("photometry = \"table\"\ngamma_deg = [0, 30, 60, 90]\ncd_per_klm = [50, 100, 130, 0]\n");
  const json lamp = Fit()["luminaires"][0];
  EXPECT_LT((PositionOf(lamp) - kLamp).norm(), 0.005);
  EXPECT_NEAR(lamp["flux_lm"].get<double>() / BatwingFluxLm(), 1, 0.01);
}

// At a place that is known: readings on one plane fit any height with another lobe.
TEST_F(FitOfReadings, FittedTable) {
  WriteReadings([](const Eigen::Vector3d& at, int) { return BatwingLux(at); });
  WriteSession(
      "photometry = \"table\"\nshape = \"point\"\naim = [0, 0, -1]\nposition_m = [0.2, -0.1, "
      "1.5]\nposition_sigma_m = 0\n");
  const json lamp = Fit()["luminaires"][0];
  ASSERT_TRUE(lamp.contains("gamma_deg")) << lamp;
  const double flux_lm = lamp["flux_lm"];
  // Seen by the readings: up to 60 degrees.
  for (size_t j = 0; j < lamp["gamma_deg"].size(); ++j) {
    const double gamma_deg = lamp["gamma_deg"][j];
    if (gamma_deg < 7 || gamma_deg > 55) continue;
    const double fitted_cd = flux_lm / 1000 * lamp["cd_per_klm"][j].get<double>();
    // The nodes' own spacing rounds off the kink at 30 degrees.
    EXPECT_NEAR(fitted_cd / BatwingCd(gamma_deg * kPi / 180), 1, 0.04) << gamma_deg;
  }
}

TEST_F(FitOfReadings, GivenEmission) {
  // Two halves of 0.6 m x 0.6 m, 750 lm and 250 lm.
  const Eigen::Vector3d half(0.3, 0, 0);
  WriteReadings([&](const Eigen::Vector3d& at, int) {
    return support::LambertianRectangleLx(750, kLamp - half, 0.6, 0.6, at) +
           support::LambertianRectangleLx(250, kLamp + half, 0.6, 0.6, at);
  });
  const std::string rectangle =
      "photometry = \"lambertian\"\nshape = \"rectangle\"\nsize_m = [1.2, 0.6]\naim = [0, 0, -1]\nheading = "
      "[1, 0, 0]\n";
  WriteSession(rectangle + "emission = [[3, 1]]\n");
  const json lamp = Fit()["luminaires"][0];
  EXPECT_LT((PositionOf(lamp) - kLamp).norm(), 0.01);
  EXPECT_NEAR(lamp["flux_lm"].get<double>(), 1000, 10);
  EXPECT_NEAR(lamp["emission"][0][0].get<double>() / lamp["emission"][0][1].get<double>(), 3, 1e-6);
}

TEST_F(FitOfReadings, SensorsHaveGainsOfTheirOwn) {
  const std::vector<double> gain{1.05, 0.97, 0.98};
  WriteReadings(
      [&](const Eigen::Vector3d& at, int row) {
        return gain[static_cast<size_t>(row % 3)] * support::LambertianRectangleLx(1000, kLamp, 0.1, 0.1, at);
      },
      3);
  WriteSession("photometry = \"lambertian\"\nshape = \"point\"\naim = [0, 0, -1]\n");
  const json result = Fit();
  const json& lamp = result["luminaires"][0];
  EXPECT_LT((PositionOf(lamp) - kLamp).norm(), 0.01);
  // The three sensors' mean gain is 1.
  EXPECT_NEAR(lamp["flux_lm"].get<double>(), 1000, 10);
  // Without the column, the rows' gains are a model error of the light's.
  WriteReadings([&](const Eigen::Vector3d& at, int row) {
    return gain[static_cast<size_t>(row % 3)] * support::LambertianRectangleLx(1000, kLamp, 0.1, 0.1, at);
  });
  const json blind = Fit("blind");
  EXPECT_GT(blind["luminaires"][0]["position_sigma_m"][0].get<double>(),
            lamp["position_sigma_m"][0].get<double>());
}

TEST_F(FitOfReadings, LuminairesOfAnEarlierResultStayAsTheyWere) {
  WriteReadings([](const Eigen::Vector3d& at, int) {
    return support::LambertianRectangleLx(1000, kLamp, 0.1, 0.1, at);
  });
  WriteSession("photometry = \"lambertian\"\nshape = \"point\"\naim = [0, 0, -1]\n");
  const json first = Fit("first")["luminaires"][0];
  EXPECT_LT((PositionOf(first) - kLamp).norm(), 0.01);
  // Twice the light: a fit would double the flux.
  WriteReadings([](const Eigen::Vector3d& at, int) {
    return support::LambertianRectangleLx(2000, kLamp, 0.1, 0.1, at);
  });
  const json again = Fit("second", "--luminaires '" + folder_.Path("first/result.json") + "'");
  const json& second = again["luminaires"][0];
  EXPECT_NEAR(second["flux_lm"].get<double>(), first["flux_lm"].get<double>(), 1e-6);
  EXPECT_LT((PositionOf(second) - PositionOf(first)).norm(), 1e-9);
  for (const json& reading : again["luxmeter"])
    EXPECT_NEAR(reading["predicted_lx"].get<double>() / reading["measured_lx"].get<double>(), 0.5, 0.01);
}

}  // namespace
}  // namespace luxfit
