#include "calib/luminance/vignetting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "calib/luminance/luminance.h"
#include "tests/support/calib/camera_model.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr int kWidth = 480, kHeight = 360, kPhotos = 12;
constexpr double kCornerAngle = 0.7;  // rad: cos^4 = 0.34

double Truth(const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d center((kWidth - 1) / 2.0, (kHeight - 1) / 2.0);
  return support::NaturalVignetting((pixel - center).norm() / (std::hypot(kWidth, kHeight) / 2),
                                    kCornerAngle);
}

// 400 surfaces, each in some photos at places at random.
template <typename Rng>
std::vector<VignettingSample> Samples(bool vignetted, const Eigen::VectorXd& log_gain, double outlier_share,
                                      Rng& rng) {
  std::uniform_real_distribution<double> u(0, kWidth - 1), v(0, kHeight - 1), unit(0, 1);
  std::normal_distribution<double> noise(0, 0.01);
  std::vector<VignettingSample> samples;
  for (int surface = 0; surface < 400; ++surface) {
    const double luminance = std::exp(3 * unit(rng));
    for (int photo = 0; photo < kPhotos; ++photo) {
      if (unit(rng) > 0.3) continue;
      VignettingSample sample{photo, {u(rng), v(rng)}, surface, luminance, 0.01};
      if (vignetted) sample.value *= Truth(sample.pixel);
      sample.value *= std::exp(log_gain[photo] + noise(rng));
      if (unit(rng) < outlier_share) sample.value *= 1.5;  // a glossy surface that mirrors a lamp
      samples.push_back(sample);
    }
  }
  return samples;
}

// Over the picture, root mean square.
double ErrorOf(const Vignetting& vignetting) {
  double squares = 0, count = 0;
  for (int v = 0; v < kHeight; v += 20) {
    for (int u = 0; u < kWidth; u += 20) {
      squares += std::pow(vignetting.At({u, v}) / Truth({u, v}) - 1, 2);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

TEST(EstimateVignettingTest, FindsTheLensFromSurfacesSeenAtManyPlaces) {
  auto rng = support::TestRng();
  const auto samples = Samples(true, Eigen::VectorXd::Zero(kPhotos), 0, rng);
  const VignettingEstimate estimate = EstimateVignetting(samples, kPhotos, NoVignetting(kWidth, kHeight));
  ASSERT_TRUE(estimate.is_determined) << estimate.message;
  EXPECT_GE(estimate.vignetting.coefficients.size(), 1);
  // 1400 samples of 1 % and three terms: 0.05 % where photos are full, the corners (1 % of the area) some
  // times that.
  EXPECT_LT(ErrorOf(estimate.vignetting), 0.003);
  EXPECT_NEAR(estimate.residual_rms, 0.01, 0.002);
}

TEST(EstimateVignettingTest, GainsAreFoundBesideItAndOutliersDoNotMoveIt) {
  auto rng = support::TestRng();
  Eigen::VectorXd log_gain = 0.02 * Eigen::VectorXd::LinSpaced(kPhotos, -1, 1);
  const auto samples = Samples(true, log_gain, 0.05, rng);
  const VignettingEstimate estimate = EstimateVignetting(samples, kPhotos, NoVignetting(kWidth, kHeight));
  ASSERT_TRUE(estimate.is_determined) << estimate.message;
  EXPECT_LT(ErrorOf(estimate.vignetting), 0.005);
  EXPECT_LT((estimate.log_gain - log_gain).cwiseAbs().maxCoeff(), 0.006);
}

TEST(EstimateVignettingTest, NoneIsFoundWhereThereIsNone) {
  auto rng = support::TestRng();
  const auto samples = Samples(false, Eigen::VectorXd::Zero(kPhotos), 0, rng);
  const VignettingEstimate estimate = EstimateVignetting(samples, kPhotos, NoVignetting(kWidth, kHeight));
  ASSERT_TRUE(estimate.is_determined) << estimate.message;
  EXPECT_EQ(estimate.vignetting.coefficients.size(), 0);
}

TEST(EstimateVignettingTest, SurfacesAlwaysAtOnePlaceDetermineNothing) {
  auto rng = support::TestRng();
  auto samples = Samples(true, Eigen::VectorXd::Zero(kPhotos), 0, rng);
  for (VignettingSample& sample : samples) sample.pixel = {10.0 + sample.surface, 100.0};
  const VignettingEstimate estimate = EstimateVignetting(samples, kPhotos, NoVignetting(kWidth, kHeight));
  EXPECT_FALSE(estimate.is_determined);
  EXPECT_FALSE(estimate.message.empty());
  EXPECT_EQ(estimate.vignetting.coefficients.size(), 0);
}

TEST(EstimateVignettingTest, FlatFieldGivesItDirectly) {
  auto rng = support::TestRng();
  const support::CameraModel camera;
  auto scene = support::LogRamp(kHeight, kWidth, 0.7, 0.7);
  for (ImagePlane& plane : scene) {
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) plane(v, u) *= static_cast<float>(Truth({u, v}));
    }
  }
  const LuminanceImage photo = ToRelativeLuminance(support::Shoot(camera, scene, 1, rng), 1);
  const VignettingEstimate estimate = VignettingOfFlatField(photo);
  ASSERT_TRUE(estimate.is_determined) << estimate.message;
  EXPECT_LT(ErrorOf(estimate.vignetting), 0.003);
  const LuminanceImage flat = WithoutVignetting(photo, estimate.vignetting);
  EXPECT_NEAR(flat.relative_luminance.block(0, 0, 20, 20).mean() / 0.7, 1, 0.01);
}

TEST(EstimateVignettingTest, RefusesWhatHasNoMeaning) {
  const Vignetting none = NoVignetting(10, 10);
  EXPECT_FALSE(EstimateVignetting({}, 0, none).is_determined);
  EXPECT_THROW(EstimateVignetting({{0, {1, 1}, 0, -1, 0.1}}, 1, none), std::invalid_argument);
  EXPECT_THROW(EstimateVignetting({{1, {1, 1}, 0, 1, 0.1}}, 1, none), std::invalid_argument);
}

}  // namespace
}  // namespace luxfit
