#include "calib/lens/projection_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calib/calibrate/calibration.h"
#include "tests/support/calib/board_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::BoardViewsOptions;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where a point fixed to the boards of `reference`, seen at `pixel` there, is seen by another calibration of
// the same boards: mean over boards, in full, nothing linearised.
Eigen::Vector2d CarriedPixel(const Calibration& reference, const Calibration& other,
                             const Eigen::Vector2d& pixel, double range_m) {
  const Eigen::Vector3d p = range_m * Unproject(reference.cameras[0].camera, pixel);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < reference.images.size(); ++i)
    mean += other.images[i].cam_from_target * (reference.images[i].cam_from_target.inverse() * p);
  return Project(other.cameras[0].camera, mean / static_cast<double>(reference.images.size()));
}

// Corners projected by the reference's own fit, with fresh noise.
CalibrationInput Resampled(const CalibrationInput& input, const Calibration& reference, double noise_px,
                           std::mt19937_64& rng) {
  CalibrationInput fresh = input;
  std::normal_distribution<double> noise(0, noise_px);
  for (std::size_t i = 0; i < fresh.images.size(); ++i) {
    for (BoardCorner& corner : fresh.images[i].corners) {
      corner.pixel = support::OpenCvPixel(reference.cameras[0].camera,
                                          reference.images[i].cam_from_target *
                                              input.target.points[static_cast<std::size_t>(corner.index)]) +
                     Eigen::Vector2d(noise(rng), noise(rng));
    }
  }
  return fresh;
}

TEST(ProjectionUncertainty, IsTheScatterOfCalibrationsFromFreshNoise) {
  auto rng = support::TestRng();
  BoardViewsOptions views;
  views.images = 8;
  const CalibrationInput input = support::ViewsOf(support::OpenCv8Camera(), views, rng);
  CalibrateCamerasOptions options;
  options.lenses = {{LensModel::kOpenCv, 4, 0}};
  options.board_may_bend = false;
  options.outlier_sigmas = 50;
  options.folds = 2;
  const Calibration reference = CalibrateCameras(input, options);
  ASSERT_TRUE(reference.converged);
  ProjectionCovariance predicted = reference.cameras[0].uncertainty;
  constexpr double kNoisePx = 0.3;
  predicted.covariance *= std::pow(kNoisePx / predicted.noise_px, 2);
  options.focal_start_px = reference.cameras[0].camera.fx_px;
  const std::vector<Eigen::Vector2d> pixels = {{640, 480}, {300, 250}, {1100, 800}, {60, 60}};
  const std::vector<double> ranges_m = {0.7, 3};
  std::vector<double> sums(pixels.size() * ranges_m.size(), 0);
  constexpr int kSamples = 40;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Calibration refit = CalibrateCameras(Resampled(input, reference, kNoisePx, rng), options);
    ASSERT_EQ(refit.images.size(), reference.images.size());
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const Eigen::Vector2d& pixel = pixels[k % pixels.size()];
      sums[k] += (CarriedPixel(reference, refit, pixel, ranges_m[k / pixels.size()]) - pixel).squaredNorm();
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const Eigen::Vector2d& pixel = pixels[k % pixels.size()];
    const double expected = std::sqrt(
        ProjectionCovarianceAt(reference.cameras[0].camera, predicted, pixel, ranges_m[k / pixels.size()])
            .trace());
    // The root of a sum of 80 squares scatters by 8 % (11 % where one direction has all of it): three of
    // these.
    EXPECT_NEAR(std::sqrt(sums[k] / kSamples), expected, 0.25 * expected) << pixel.transpose();
  }
}

TEST(ProjectionUncertainty, GrowsWhereNoCornerWas) {
  auto rng = support::TestRng();
  BoardViewsOptions views;
  views.images = 20;
  views.reach = 0.1;
  views.nearest_m = 1.2;
  views.farthest_m = 1.8;
  const Calibration result =
      CalibrateCameras(support::ViewsOf(support::OpenCv8Camera(), views, rng),
                       {{{LensModel::kOpenCv, 8, 0}}, CalibrationBackEnd::kMrcal, 5, 4, 0, true, {}});
  ASSERT_TRUE(result.converged);
  const CalibratedCamera& camera = result.cameras[0];
  const auto sigma_px = [&](double x, double y) {
    return ProjectionSigmaPx(camera.camera, camera.uncertainty, {x, y}, kInfinity);
  };
  EXPECT_GT(sigma_px(30, 30), 5 * sigma_px(640, 480));
  const Eigen::MatrixXd map = ProjectionSigmaMap(camera.camera, camera.uncertainty, 8, 6, kInfinity);
  EXPECT_EQ(map.rows(), 6);
  EXPECT_EQ(map.cols(), 8);
  EXPECT_DOUBLE_EQ(map(0, 0), sigma_px(0.5 * 160 - 0.5, 0.5 * 160 - 0.5));
}

TEST(ProjectionUncertainty, NothingKnownIsNotANumber) {
  ProjectionCovariance nothing;
  nothing.kind = {LensModel::kOpenCv, 8, 0};
  EXPECT_TRUE(std::isnan(ProjectionSigmaPx(support::OpenCv8Camera(), nothing, {100, 100}, 1)));
}

}  // namespace
}  // namespace luxfit
