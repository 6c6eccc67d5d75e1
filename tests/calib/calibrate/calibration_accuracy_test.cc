// What issue "calib" promises of accuracy, on boards of known truth with 0.3 px of noise, and enough of them.
#include <gtest/gtest.h>

#include "calib/calibrate/calibration.h"
#include "tests/support/calib/board_views.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::BoardViewsOptions;
using support::FisheyeCamera;
using support::OpenCv8Camera;
using support::TestRng;
using support::ViewsOf;

constexpr double kNoisePx = 0.3;

CalibrateCamerasOptions Only(const std::string& lens) {
  CalibrateCamerasOptions options;
  options.lenses = {*LensKindOf(lens)};
  return options;
}

TEST(CalibrationAccuracy, RecoversALensFromNoisyBoards) {
  auto rng = TestRng();
  const Camera truth = OpenCv8Camera();
  BoardViewsOptions views;
  views.images = 100;
  const Calibration result =
      CalibrateCameras(ViewsOf(truth, views, rng, support::GridTarget(24, 18, 0.025)), Only("opencv8"));
  ASSERT_TRUE(result.IsUsable()) << result.message;
  const CalibratedCamera& camera = result.cameras.front();
  // One sigma is 0.008 % here.
  EXPECT_NEAR(camera.camera.fx_px, truth.fx_px, 2e-4 * truth.fx_px);
  EXPECT_NEAR(camera.camera.fy_px, truth.fy_px, 2e-4 * truth.fy_px);
  // 70 000 residuals: their rms is known to 0.3 %.
  EXPECT_NEAR(result.held_out_px, kNoisePx, 0.01 * kNoisePx);
  EXPECT_NEAR(result.noise_px, kNoisePx, 0.01 * kNoisePx);
  EXPECT_NEAR(result.rms_2d_px, std::sqrt(2.0) * result.rms_px, 1e-12);
  EXPECT_LT(support::LensDifferencePx(truth, camera.camera, 0.8), 0.05);
  EXPECT_LT(result.outlier_share, 2e-3);
  EXPECT_TRUE(result.board_bend_m.isZero()) << "a flat board is no bent one";
  EXPECT_EQ(camera.uncertain_share, 0);
}

TEST(CalibrationAccuracy, FisheyeLensesAreFittedBySplinesToo) {
  auto rng = TestRng();
  const Camera truth = FisheyeCamera();
  BoardViewsOptions views;
  views.images = 60;
  views.nearest_m = 0.15;
  views.farthest_m = 0.45;
  const CalibrationInput input = ViewsOf(truth, views, rng);
  const Calibration fisheye = CalibrateCameras(input, Only("fisheye"));
  ASSERT_TRUE(fisheye.IsUsable()) << fisheye.message;
  EXPECT_NEAR(fisheye.cameras[0].camera.fx_px, truth.fx_px, 5e-4 * truth.fx_px);
  EXPECT_NEAR(fisheye.held_out_px, kNoisePx, 0.02 * kNoisePx);
  const Calibration splined = CalibrateCameras(input, Only("splined8"));
  ASSERT_TRUE(splined.converged) << splined.message;
  // Its core means something else, so lenses are compared by where they put directions.
  EXPECT_LT(support::LensDifferencePx(truth, splined.cameras[0].camera, 0.8), 0.15);
  EXPECT_NEAR(splined.held_out_px, kNoisePx, 0.1 * kNoisePx);
}

}  // namespace
}  // namespace luxfit
