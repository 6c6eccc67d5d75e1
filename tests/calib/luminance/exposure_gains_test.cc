#include "calib/luminance/exposure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/calib/camera_model.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Photos of one scene with the exposures that the camera took, read with those that it states.
template <typename Rng>
ExposureGains GainsOf(const std::vector<double>& taken, const std::vector<double>& stated, Rng& rng) {
  const support::CameraModel camera;
  const auto scene = support::LogRamp(60, 200, 1e-3, 6);
  std::vector<LuminanceImage> images;
  for (size_t i = 0; i < taken.size(); ++i)
    images.push_back(ToRelativeLuminance(support::Shoot(camera, scene, taken[i], rng), stated[i]));
  std::vector<ExposureRatio> ratios;
  for (int i = 0; i + 1 < static_cast<int>(taken.size()); ++i) {
    const size_t a = static_cast<size_t>(i);
    auto ratio = MeasureRatio(images[a], stated[a], images[a + 1], stated[a + 1]);
    if (!ratio) continue;
    ratio->first = i;
    ratio->second = i + 1;
    ratios.push_back(*ratio);
  }
  return SolveGains(static_cast<int>(taken.size()), ratios);
}

TEST(ExposureGainsTest, TrueExposuresGetNoGain) {
  auto rng = support::TestRng();
  const std::vector<double> exposures{2, 1, 0.5, 0.25};
  const ExposureGains gains = GainsOf(exposures, exposures, rng);
  EXPECT_THAT(gains.off, IsEmpty());
  // Half of the least sigma of a ratio, 0.1 %, plus the dark pixels' bias.
  EXPECT_LT(gains.log_gain.cwiseAbs().maxCoeff(), 2e-3);
}

TEST(ExposureGainsTest, OnePhotoOfFiveWithTwiceTheIsoIsNamedAndTheOthersStay) {
  auto rng = support::TestRng();
  const ExposureGains gains = GainsOf({2, 1, 1, 0.25, 0.125}, {2, 1, 0.5, 0.25, 0.125}, rng);
  EXPECT_THAT(gains.off, ElementsAre(2));
  EXPECT_NEAR(gains.log_gain[2], std::log(2), 0.01);
  for (const int i : {0, 1, 3, 4}) EXPECT_LT(std::abs(gains.log_gain[i]), 0.01) << i;
}

TEST(ExposureGainsTest, LabelsOfTheDialAreToldFromItsTimes) {
  auto rng = support::TestRng();
  // 1/8, 1/15, 1/30, 1/60 are 2^-3 to 2^-6 s; 8 times as bright a scene, so that counts suffice.
  const std::vector<double> taken{1, 0.5, 0.25, 0.125}, labels{1, 8.0 / 15, 8.0 / 30, 8.0 / 60};
  const ExposureGains gains = GainsOf(taken, labels, rng);
  for (const int i : {1, 2, 3}) {
    const size_t at = static_cast<size_t>(i);
    // Ratios are what is seen: of each photo to the first.
    EXPECT_NEAR(gains.log_gain[i] - gains.log_gain[0], std::log(taken[at] / labels[at]), 4e-3) << i;
  }
}

TEST(ExposureGainsTest, WithoutOverlapNothingIsClaimed) {
  auto rng = support::TestRng();
  const support::CameraModel camera;
  const auto scene = support::LogRamp(60, 200, 1e-3, 1e-2);
  const LuminanceImage lit = ToRelativeLuminance(support::Shoot(camera, scene, 1, rng), 1);
  EXPECT_FALSE(MeasureRatio(lit, 1, lit, 1).has_value());  // all below 2 % of full scale
  const ExposureGains gains = SolveGains(2, {});
  EXPECT_EQ(gains.log_gain, Eigen::Vector2d::Zero());
  EXPECT_THAT(gains.off, IsEmpty());
}

TEST(ExposureGainsTest, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(SolveGains(2, {{0, 2, 0, 0.1, 100}}), std::invalid_argument);
  EXPECT_THROW(SolveGains(2, {{0, 1, 0, 0, 100}}), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
