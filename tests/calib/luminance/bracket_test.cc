#include "calib/luminance/bracket.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/support/calib/camera_model.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::CameraModel;
using support::LogRamp;
using support::Shoot;

const std::vector<double> kExposures{8, 2, 0.5, 0.125};

LuminanceOptions WithNoise(const CameraModel& camera) {
  LuminanceOptions options;
  options.black_level_counts = camera.black_counts;
  const double rounding = 1 / (camera.full_scale_counts * std::sqrt(12.0));
  options.noise =
      SensorNoise{std::hypot(camera.read_electrons / camera.full_well, rounding), 1 / camera.full_well};
  return options;
}

TEST(BracketTest, FourDecadesAreUnbiasedWithinTheirStatedVariance) {
  auto rng = support::TestRng();
  CameraModel camera;
  camera.full_scale_counts = 16383;
  camera.black_counts = 512;
  const auto truth = LogRamp(200, 300, 5e-4, 6.0);
  BracketMerger merger(WithNoise(camera));
  for (const double exposure : kExposures) merger.Add(Shoot(camera, truth, exposure, rng), exposure);
  const LuminanceImage merged = merger.Merged();
  // Of 60 000 independent pixels: the mean of z is known to 0.004, its spread to 0.003.
  double sum = 0, squares = 0, worst_column = 0;
  for (int u = 0; u < 300; ++u) {
    double column = 0;
    for (int v = 0; v < 200; ++v) {
      ASSERT_TRUE(merged.valid(v, u)) << u;
      const double z = (merged.relative_luminance(v, u) - truth[0](v, u)) / std::sqrt(merged.variance(v, u));
      sum += z;
      squares += z * z;
      column += z;
    }
    worst_column = std::max(worst_column, std::abs(column) / std::sqrt(200.0));
  }
  EXPECT_NEAR(sum / 60000, 0, 0.02);
  EXPECT_NEAR(std::sqrt(squares / 60000), 1, 0.02);
  // 300 columns: one of 4.5 sigma comes by chance in 500 runs.
  EXPECT_LT(worst_column, 4.5);
}

TEST(BracketTest, IsNeverNoisierThanItsBestExposure) {
  const CameraModel camera;
  auto rng = support::TestRng();
  const auto truth = LogRamp(4, 100, 1e-3, 6.0);
  const LuminanceOptions options = WithNoise(camera);
  BracketMerger merger(options);
  std::vector<LuminanceImage> single;
  for (const double exposure : kExposures) {
    const Photo photo = Shoot(camera, truth, exposure, rng);
    merger.Add(photo, exposure);
    single.push_back(ToRelativeLuminance(photo, exposure, options));
  }
  const LuminanceImage merged = merger.Merged();
  for (int u = 0; u < 100; ++u) {
    for (const LuminanceImage& one : single) {
      // The single one's variance follows its own noise: 3 % of its counts at the least counts allowed here.
      if (one.valid(0, u)) {
        EXPECT_LT(merged.variance(0, u), 1.1 * one.variance(0, u)) << u;
      }
    }
  }
}

TEST(BracketTest, SaturatedPixelsAndTheirNeighboursAreLeftOutExposureByExposure) {
  CameraModel camera;
  camera.full_well = 0;
  std::mt19937_64 rng;
  auto truth = LogRamp(9, 9, 0.1, 0.1);
  truth[2](4, 4) = 3;  // saturates at 1 s, not at 0.125 s
  Photo bled = Shoot(camera, truth, 1, rng);
  for (ImagePlane& plane : bled.rgb_counts) plane(4, 5) = 40000;  // beside it, below saturation and wrong
  BracketMerger merger{LuminanceOptions{}};
  merger.Add(bled, 1);
  merger.Add(Shoot(camera, truth, 0.125, rng), 0.125);
  const LuminanceImage merged = merger.Merged();
  EXPECT_TRUE(merged.valid.all());
  EXPECT_FALSE(merged.saturated.any());
  // Rounding of 0.125 s: 0.5 / 65535 / 0.125.
  EXPECT_NEAR(merged.relative_rgb[2](4, 4), 3, 1e-4);
  EXPECT_NEAR(merged.relative_rgb[2](4, 5), 0.1, 1e-4);
}

TEST(BracketTest, SaturatedInEveryExposureStaysSo) {
  CameraModel camera;
  camera.full_well = 0;
  std::mt19937_64 rng;
  auto truth = LogRamp(9, 9, 0.1, 0.1);
  truth[0](4, 4) = 100;
  BracketMerger merger{LuminanceOptions{}};
  for (const double exposure : {1.0, 0.125}) merger.Add(Shoot(camera, truth, exposure, rng), exposure);
  const LuminanceImage merged = merger.Merged();
  EXPECT_TRUE(merged.saturated(4, 4));
  EXPECT_FALSE(merged.valid(4, 4));
  // Shown as bright as the shortest exposure had it: tags beside lamps are detected in this picture.
  EXPECT_NEAR(merged.relative_rgb[0](4, 4), 8, 1e-3);
  EXPECT_EQ(merged.valid.count(), 81 - 25);
}

TEST(BracketTest, OneExposureIsThePhotoItself) {
  const CameraModel camera;
  auto rng = support::TestRng();
  const Photo photo = Shoot(camera, LogRamp(6, 40, 1e-5, 2), 0.5, rng);
  BracketMerger merger(WithNoise(camera));
  merger.Add(photo, 0.5);
  const LuminanceImage merged = merger.Merged(), single = ToRelativeLuminance(photo, 0.5, WithNoise(camera));
  EXPECT_TRUE((merged.valid == single.valid).all());
  EXPECT_TRUE((merged.saturated == single.saturated).all());
  EXPECT_TRUE(
      merged.valid.select(merged.relative_luminance / single.relative_luminance - 1, 0.0f).abs().maxCoeff() <
      1e-5);
}

TEST(BracketTest, EightBitsOfKnownResponseAreMerged) {
  CameraModel camera;
  camera.response = support::SrgbEncoded;
  camera.bits = 8;
  camera.full_scale_counts = 255;
  camera.full_well = 0;
  std::mt19937_64 rng;
  Eigen::VectorXd counts = Eigen::VectorXd::LinSpaced(256, 0, 255);
  const Eigen::VectorXd curve = (counts / 255).unaryExpr(&support::SrgbDecoded);
  LuminanceOptions options;
  options.response = CameraResponse(counts, {curve, curve, curve});
  const auto truth = LogRamp(2, 400, 1e-3, 6.0);
  BracketMerger merger(options);
  for (const double exposure : {16.0, 4.0, 1.0, 0.25, 0.125})
    merger.Add(Shoot(camera, truth, exposure, rng), exposure);
  const LuminanceImage merged = merger.Merged();
  ASSERT_TRUE(merged.valid.all());
  // The darkest pixel has 33 counts at 16 s: half a count, through d ln X / d ln count = 1.7, is 2.6 %.
  const ImagePlane error = (merged.relative_luminance / truth[0] - 1).abs();
  EXPECT_LT(error.maxCoeff(), 0.026);
  EXPECT_LT(error.mean(), 0.004);
}

TEST(BracketTest, RefusesWhatHasNoMeaning) {
  const CameraModel camera;
  auto rng = support::TestRng();
  BracketMerger merger{LuminanceOptions{}};
  EXPECT_THROW(merger.Merged(), std::invalid_argument);
  merger.Add(Shoot(camera, LogRamp(4, 4, 0.1, 0.2), 1, rng), 1);
  EXPECT_THROW(merger.Add(Shoot(camera, LogRamp(4, 4, 0.1, 0.2), 2, rng), 2), std::invalid_argument);
  EXPECT_THROW(merger.Add(Shoot(camera, LogRamp(4, 5, 0.1, 0.2), 1, rng), 0.5), std::invalid_argument);
}

TEST(WithoutAmbientTest, SubtractsChannelsAndAddsVariances) {
  const CameraModel camera;
  auto rng = support::TestRng();
  const auto ambient = LogRamp(100, 100, 0.1, 0.1);
  const auto both = LogRamp(100, 100, 0.3, 0.3);
  const LuminanceOptions options = WithNoise(camera);
  const LuminanceImage net = WithoutAmbient(ToRelativeLuminance(Shoot(camera, both, 1, rng), 1, options),
                                            ToRelativeLuminance(Shoot(camera, ambient, 2, rng), 2, options));
  ASSERT_TRUE(net.valid.all());
  const ImagePlane error = net.relative_luminance - 0.2f;
  EXPECT_NEAR((error.square() / net.variance).mean(), 1, 0.06);  // 10 000 pixels: 1.4 %
  EXPECT_THROW(WithoutAmbient(net, LuminanceImage{}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
