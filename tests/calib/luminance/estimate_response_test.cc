#include "calib/luminance/response.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tests/support/calib/camera_model.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::CameraModel;

// Pixels of random luminance over three decades and a half, shot by a camera of known response.
template <typename Rng>
BracketSamples Shots(const CameraModel& camera, int pixels, const std::vector<double>& exposures, Rng& rng) {
  std::uniform_real_distribution<double> decades(-3, 0.5);
  std::array<ImagePlane, 3> scene;
  for (ImagePlane& plane : scene) {
    plane = ImagePlane::Zero(1, pixels).unaryExpr(
        [&](float) { return static_cast<float>(std::pow(10, decades(rng))); });
  }
  BracketSamples samples;
  samples.exposure_s =
      Eigen::Map<const Eigen::VectorXd>(exposures.data(), static_cast<Eigen::Index>(exposures.size()));
  for (Eigen::MatrixXd& counts : samples.counts) counts.resize(pixels, samples.exposure_s.size());
  for (Eigen::Index j = 0; j < samples.exposure_s.size(); ++j) {
    const Photo photo = support::Shoot(camera, scene, samples.exposure_s[j], rng);
    for (size_t c = 0; c < 3; ++c)
      samples.counts[c].col(j) = photo.rgb_counts[c].row(0).transpose().cast<double>();
  }
  return samples;
}

const std::vector<double> kExposureRatios{16, 8, 4, 2, 1, 0.5, 0.25};

CameraModel FilmCamera() {
  CameraModel camera;
  camera.response = support::FilmEncoded;
  camera.bits = 8;
  camera.full_scale_counts = 255;
  camera.full_well = 9 * 20000;  // a sample is the mean of 3 x 3 pixels
  return camera;
}

// Largest |ln| error of the ratio of exposures between counts of 4 % and 96 % and half scale.
double WorstError(const CameraResponse& response, const std::function<double(double)>& decoded, double full) {
  double worst = 0;
  for (double share = 0.04; share < 0.96; share += 0.01) {
    const double ratio = response.Exposure(1, share * full) / response.Exposure(1, 0.5 * full);
    worst = std::max(worst, std::abs(std::log(ratio / (decoded(share) / decoded(0.5)))));
  }
  return worst;
}

// The inverse of FilmEncoded by bisection.
double FilmDecoded(double y) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) (support::FilmEncoded((low + high) / 2) < y ? low : high) = (low + high) / 2;
  return low;
}

TEST(EstimateResponseTest, DebevecFindsAFilmCurve) {
  auto rng = support::TestRng();
  const std::vector<BracketSamples> samples{Shots(FilmCamera(), 1000, kExposureRatios, rng)};
  const CameraResponse response = SolveDebevec(samples, ResponseOptions{}, {1e-4});
  // At 4 % (10 counts) and at the shoulder one count is 9 % of exposure; some ten samples a knot average it.
  EXPECT_LT(WorstError(response, FilmDecoded, 255), 0.02);
}

TEST(EstimateResponseTest, RobertsonFindsTheEncodingOfEightBitPictures) {
  auto rng = support::TestRng();
  CameraModel camera = FilmCamera();
  camera.response = support::SrgbEncoded;
  const std::vector<BracketSamples> samples{Shots(camera, 20000, kExposureRatios, rng)};
  const CameraResponse response = SolveRobertson(samples, ResponseOptions{});
  // Nothing smooths it: half a count of the darkest 10 is 5 % of exposure.
  EXPECT_LT(WorstError(response, support::SrgbDecoded, 255), 0.05);
}

TEST(EstimateResponseTest, TheBetterOnHeldOutExposuresIsTakenAndBeatsALinearOne) {
  auto rng = support::TestRng();
  const std::vector<BracketSamples> samples{Shots(FilmCamera(), 1000, kExposureRatios, rng)};
  const ResponseEstimate estimate = EstimateResponse(samples, ResponseOptions{});
  ASSERT_TRUE(estimate.response.has_value()) << estimate.message;
  // Within one standard error, which is about 1 % of some ten thousand errors' mean.
  for (const ResponseScore& score : estimate.scores)
    EXPECT_GE(1.03 * score.held_out_error_counts, estimate.scores[estimate.chosen].held_out_error_counts);
  // Rounding to whole counts alone is 0.25 on average.
  EXPECT_LT(estimate.scores[estimate.chosen].held_out_error_counts, 0.6);
  EXPECT_EQ(estimate.scores[0].method, "linear");
  EXPECT_GT(estimate.scores[0].held_out_error_counts, 10);
  EXPECT_LT(WorstError(*estimate.response, FilmDecoded, 255), 0.02);
}

TEST(EstimateResponseTest, WhatIsSimpleIsTakenAsSuch) {
  auto rng = support::TestRng();
  const auto chosen = [&](const CameraModel& camera) {
    // Two stops apart, as cameras bracket: estimated curves are loose there.
    const ResponseEstimate estimate = EstimateResponse(
        {Shots(camera, 500, {4, 1, 0.25, 0.0625}, rng), Shots(camera, 500, {4, 1, 0.25, 0.0625}, rng)}, {});
    return estimate.scores.at(estimate.chosen).method;
  };
  CameraModel camera = FilmCamera();
  EXPECT_THAT(chosen(camera), testing::AnyOf(testing::HasSubstr("debevec"), "robertson"));
  camera.response = support::SrgbEncoded;
  EXPECT_EQ(chosen(camera), "sRGB");
  camera.response = nullptr;
  EXPECT_EQ(chosen(camera), "linear");
}

double BentSrgbEncoded(double light) { return support::SrgbEncoded(std::pow(light, 0.9)); }

double BentSrgbDecoded(double share) { return std::pow(support::SrgbDecoded(share), 1 / 0.9); }

// As many phones and cameras bracket at least: one pair.
TEST(EstimateResponseTest, TwoExposuresAStopApartTellTheCurve) {
  auto rng = support::TestRng();
  CameraModel camera = FilmCamera();
  const auto estimated = [&](double ratio) {
    const ResponseEstimate estimate =
        EstimateResponse({Shots(camera, 600, {ratio, 1}, rng), Shots(camera, 600, {ratio, 1}, rng)}, {});
    EXPECT_TRUE(estimate.response.has_value()) << estimate.message;
    return std::pair(estimate.scores.at(estimate.chosen).method, estimate.response.value());
  };
  for (const double ratio : {2, 4, 8})
    std::printf("a film's curve, step of %g: %.1f %% at most\n", ratio,
                100 * WorstError(estimated(ratio).second, FilmDecoded, 255));
  EXPECT_LT(WorstError(estimated(2).second, FilmDecoded, 255), 0.04);
  // Sigma holds what three stops leave open.
  const CameraResponse apart = estimated(8).second;
  EXPECT_GT(WorstError(apart, FilmDecoded, 255), 0.1);
  EXPECT_GT(apart.RelativeSigma(1, 128), 0.1);
  for (const double ratio : {2, 8}) {
    camera.response = BentSrgbEncoded;
    const auto [method, response] = estimated(ratio);
    EXPECT_EQ(method, "sRGB to a power");
    EXPECT_LT(WorstError(response, BentSrgbDecoded, 255), 0.01);
    EXPECT_LT(response.RelativeSigma(1, 128), 0.05);
    camera.response = support::SrgbEncoded;
    EXPECT_EQ(estimated(ratio).first, "sRGB");
    camera.response = nullptr;
    EXPECT_EQ(estimated(ratio).first, "linear");
  }
}

TEST(EstimateResponseTest, SixteenBitCurvesAreFoundToo) {
  auto rng = support::TestRng();
  CameraModel camera;
  camera.response = support::SrgbEncoded;
  camera.full_well = 9 * 20000;
  const std::vector<BracketSamples> samples{Shots(camera, 1000, kExposureRatios, rng)};
  ResponseOptions options;
  options.full_scale_counts = 65535;
  const ResponseEstimate estimate = EstimateResponse(samples, options);
  ASSERT_TRUE(estimate.response.has_value());
  EXPECT_LT(WorstError(*estimate.response, support::SrgbDecoded, 65535), 0.01);
}

TEST(EstimateResponseTest, CurvesIncreaseWhateverTheNoise) {
  auto rng = support::TestRng();
  CameraModel camera = FilmCamera();
  camera.full_well = 100;
  const std::vector<BracketSamples> samples{Shots(camera, 60, {4, 1, 0.25}, rng)};
  // CameraResponse refuses curves that do not increase.
  EXPECT_NO_THROW(SolveDebevec(samples, ResponseOptions{}, {0.01}));
  EXPECT_NO_THROW(SolveRobertson(samples, ResponseOptions{}));
}

TEST(EstimateResponseTest, WhatDoesNotDetermineItIsSaid) {
  auto rng = support::TestRng();
  const auto message = [&](const std::vector<double>& exposures) {
    const ResponseEstimate estimate =
        EstimateResponse({Shots(FilmCamera(), 100, exposures, rng)}, ResponseOptions{});
    EXPECT_FALSE(estimate.response.has_value());
    return estimate.message;
  };
  EXPECT_THAT(message({1}), testing::HasSubstr("two exposures"));
  EXPECT_THAT(message({1, 1.1, 1.2}), testing::HasSubstr("factor of two"));
  EXPECT_THAT(message({1, 1e5, 1e10}), testing::HasSubstr("well exposed"));
  EXPECT_THROW(SolveDebevec({}, ResponseOptions{}), std::invalid_argument);
}

TEST(ChooseSamplePixelsTest, TakesFlatPlacesOverTheWholeRangeAndNoneThatIsNotAllowed) {
  CameraModel camera;
  camera.bits = 8;
  camera.full_scale_counts = 255;
  camera.full_well = 0;
  std::mt19937_64 rng;
  auto scene = support::LogRamp(60, 600, 0.01, 1);
  for (ImagePlane& plane : scene)
    plane.block(20, 0, 20, 600) = plane.block(20, 0, 20, 600).rowwise().reverse().eval();
  const Photo photo = support::Shoot(camera, scene, 1, rng);
  PixelMask allowed = PixelMask::Constant(60, 600, true);
  allowed.topRows(10).setConstant(false);
  const auto places = ChooseSamplePixels(photo, 320, ResponseOptions{}, allowed);
  EXPECT_GT(places.size(), 200u);
  float least = 255, most = 0;
  for (const PixelPlace& place : places) {
    EXPECT_GE(place.v, 12);
    // Not across the border of the reversed band.
    const auto around = photo.rgb_counts[1].block<5, 5>(place.v - 2, place.u - 2);
    EXPECT_LT(around.maxCoeff() - around.minCoeff(), 16);
    least = std::min(least, photo.rgb_counts[1](place.v, place.u));
    most = std::max(most, photo.rgb_counts[1](place.v, place.u));
  }
  EXPECT_LT(least, 12);
  EXPECT_GT(most, 235);
}

TEST(CameraResponseTest, InvertsItselfAndRefusesCurvesThatFall) {
  const Eigen::Vector3d counts(0, 100, 255), curve(0, 0.1, 1);
  const CameraResponse response(counts, {curve, curve, curve});
  EXPECT_DOUBLE_EQ(response.Exposure(0, 50), 0.05);
  EXPECT_DOUBLE_EQ(response.Counts(2, 0.55), 177.5);
  EXPECT_DOUBLE_EQ(response.Slope(1, 200), 0.9 / 155);
  EXPECT_DOUBLE_EQ(response.Exposure(0, 300), 1);
  const Eigen::Vector3d falls(0, 1, 0.5);
  EXPECT_THROW(CameraResponse(counts, {curve, falls, curve}), std::invalid_argument);
  EXPECT_THROW(CameraResponse(falls, {curve, curve, curve}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
