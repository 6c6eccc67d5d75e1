// `luxfit run` on the office under lamps of two colours, seen by a sensor that does not see as CIE's observer does: the photos that an
// independent renderer made, each channel multiplied by what the sensor counts of the lamp's spectrum. A and C are LEDs of about
// 2650 K, B and D of about 5200 K; they have the fluxes of the office. Shot noise is multiplied as the light is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "calib/colour/colour_temperature.h"
#include "tests/support/apps/office_copy.h"
#include "tests/support/calib/spectral_camera.h"
#include "tests/support/truth_comparison.h"

namespace luxfit {
namespace {

using nlohmann::json;

const std::map<std::string, support::Spectrum> kLamps = {{"A", support::Led(0.6, 1.9)},
                                                         {"B", support::Led(2.2, 0.7)},
                                                         {"C", support::Led(0.6, 1.9)},
                                                         {"D", support::Led(2.2, 0.7)}};

double CctOf(const support::Spectrum& spectrum) {
  return ColourTemperatureOf(support::XyzOf(spectrum), Eigen::Matrix3d::Zero())->kelvin;
}

// Multiplies the channels of a photo. A pixel that is saturated in one channel stays so.
void MultiplyPhoto(const std::string& path, const Eigen::Vector3d& rgb) {
  constexpr double kNearlySaturated = 64000;
  cv::Mat photo = cv::imread(path, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(photo.type(), CV_16UC3);
  photo.forEach<cv::Vec3w>([&](cv::Vec3w& pixel, const int*) {
    if (std::max({pixel[0], pixel[1], pixel[2]}) > kNearlySaturated) return;
    for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<unsigned short>(pixel[c] * rgb[2 - c]);
  });
  cv::imwrite(path, photo);
}

// Returns what the sensor counts of each lamp's unit of luminance: divided by `balance`, in a unit in which no count grows.
std::map<std::string, Eigen::Vector3d> CountsOfLamps(const Eigen::Vector3d& balance) {
  std::map<std::string, Eigen::Vector3d> counts;
  double most = 0;
  for (const auto& [lamp, spectrum] : kLamps) {
    counts[lamp] = support::CountsPerLuminance(spectrum).cwiseQuotient(balance);
    most = std::max(most, counts[lamp].maxCoeff());
  }
  for (auto& [lamp, of_lamp] : counts) of_lamp /= most;
  return counts;
}

// Leaves in the office the states of one lamp, and gives its photos the sensor's colours.
void MakeColoured(const support::OfficeCopy& office, const Eigen::Vector3d& balance) {
  const auto counts = CountsOfLamps(balance);
  office.KeepPhotos([&](const std::string&, const std::string& state) { return counts.count(state) > 0; });
  office.ChangeRows("office/photos.csv", [&](const std::vector<std::string>& photo) {
    MultiplyPhoto(office.Path("office/" + photo[0]), counts.at(photo[3]));
    return true;
  });
  office.ChangeRows("office/luxmeter.csv",
                    [&](const std::vector<std::string>& reading) { return counts.count(reading[7]) > 0; });
  office.Replace("office/session.toml", "all = { A = 1.0, B = 1.0, C = 1.0, D = 1.0 }\n", "");
  office.Replace("office/session.toml", "evening = { A = 0.3, C = 1.0, D = 1.0 }\n", "");
  office.Replace("office/session.toml", "L3@all", "L3@A");
}

// Returns the largest over the smallest ratio of a fitted flux to the true one, less 1, in percent.
double SpreadOfFluxes(const json& result) {
  const json truth = json::parse(std::ifstream(support::kOfficeFolder + "truth.json"));
  const TruthComparison errors = CompareWithTruth(result, truth);
  EXPECT_EQ(errors.luminaires_missing, 0);
  double least = 1e9, most = -1e9;
  for (const auto& [id, error] : errors.luminaires) {
    least = std::min(least, error.flux_percent);
    most = std::max(most, error.flux_percent);
  }
  std::printf("worst position %.2f mm, fluxes spread by %.2f %%\n", errors.worst_position_mm, most - least);
  return most - least;
}

std::vector<std::string> CodesOf(const json& result) {
  std::vector<std::string> codes;
  for (const json& warning : result["warnings"]) codes.push_back(warning["code"]);
  return codes;
}

// The sensor's counts as they are, which the matrix turns into luminance.
TEST(LightColour, TheSensorsMatrixAndANeutralCabinetTellFluxesAndColourTemperatures) {
  const support::OfficeCopy office;
  MakeColoured(office, Eigen::Vector3d::Ones());
  const Eigen::Matrix3d matrix = support::MatrixOfSensor();
  std::vector<std::string> rows;
  for (const auto& row : matrix.rowwise())
    rows.push_back(fmt::format("[{}, {}, {}]", row[0], row[1], row[2]));
  office.Replace("office/session.toml", "vignetting = \"none\"",
                 fmt::format("vignetting = \"none\"\nxyz_from_rgb = [{}]", fmt::join(rows, ", ")));
  office.Replace("office/session.toml", "unit = \"m\"", "unit = \"m\"\nneutral = [\"cabinet\"]");
  const json result = office.ResultOf("run", 0, "--budget 900");
  EXPECT_LT(SpreadOfFluxes(result), 2);
  EXPECT_THAT(CodesOf(result), testing::Not(testing::Contains("luminance_weights_assumed")));
  for (const json& luminaire : result["luminaires"]) {
    const double truth = CctOf(kLamps.at(luminaire["id"])), found = luminaire["cct_k"],
                 sigma = luminaire["cct_sigma_k"];
    std::printf("%s: %.0f +- %.0f K, truth %.0f K, duv %.4f\n", luminaire["id"].get<std::string>().c_str(),
                found, sigma, truth, luminaire["duv"].get<double>());
    EXPECT_LT(std::abs(found - truth), 2 * sigma);
    EXPECT_LT(sigma, 0.05 * truth);
  }
}

// Photos that a camera balanced for white, and a session that does not say how its channels make luminance. Readings then contradict
// the photos, and the warning names the cause first.
TEST(LightColour, WeightsThatNobodyStatedAreWarnedOf) {
  const support::OfficeCopy office;
  MakeColoured(office, support::CountsPerLuminance(support::Planck(5000)));
  const json result = office.ResultOf("run", 1, "--budget 900");
  ASSERT_FALSE(result["warnings"].empty());
  EXPECT_EQ(result["warnings"][0]["code"], "luminance_weights_assumed");
  EXPECT_GT(SpreadOfFluxes(result), 2);  // what the warning is for
  for (const json& luminaire : result["luminaires"]) {
    EXPECT_TRUE(luminaire.contains("tint_rgb"));
    EXPECT_FALSE(luminaire.contains("cct_k"));
  }
}

}  // namespace
}  // namespace luxfit
