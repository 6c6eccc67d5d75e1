#include "inverse/albedo/photometric_stereo.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "tests/support/inverse/gray_sphere.h"
#include "tests/support/inverse/stereo_scene.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

using support::AlbedoErrorPercent;
using support::LightsAround;
using support::MeanAngleDeg;
using support::RenderStereo;
using support::StereoPicture;
using support::StereoScene;

// Lambert's sphere alone, without noise.
StereoScene PlainScene() {
  StereoScene scene;
  scene.gloss = 0;
  scene.has_second_sphere = false;
  scene.noise_sigma = 0;
  scene.pixels_across = 40;
  return scene;
}

StereoData DataOf(const StereoPicture& picture) { return {picture.value, picture.to_light, {}, {}}; }

PhotometricStereoOptions Only(StereoMethod method, CurveKind curve = CurveKind::kLambert) {
  PhotometricStereoOptions options;
  options.method = method;
  options.curves = {curve};
  return options;
}

TEST(PhotometricStereo, ExactWhereTheModelHolds) {
  std::mt19937_64 rng = support::TestRng();
  // Near the view, so that no part of the sphere's middle is in its own shadow.
  const StereoPicture picture = RenderStereo(PlainScene(), LightsAround(6, 0.25), rng);
  const PhotometricStereo result =
      SolvePhotometricStereo(DataOf(picture), Only(StereoMethod::kWithoutShadows));
  ASSERT_TRUE(result.IsUsable()) << result.message;
  EXPECT_LT(MeanAngleDeg(result.normal, picture.normal), 1e-3);
  EXPECT_LT((result.albedo - picture.albedo).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(PhotometricStereo, RobustWithstandsShadowsAndHighlights) {
  std::mt19937_64 rng = support::TestRng();
  const StereoPicture picture = RenderStereo(StereoScene{}, LightsAround(12), rng);
  const auto solve = [&](StereoMethod method) {
    return SolvePhotometricStereo(DataOf(picture), Only(method));
  };
  const PhotometricStereo plain = solve(StereoMethod::kLeastSquares);
  const PhotometricStereo thresholded = solve(StereoMethod::kWithoutShadows);
  const PhotometricStereo robust = solve(StereoMethod::kRobust);
  const double plain_deg = MeanAngleDeg(plain.normal, picture.normal);
  const double thresholded_deg = MeanAngleDeg(thresholded.normal, picture.normal);
  const double robust_deg = MeanAngleDeg(robust.normal, picture.normal);
  EXPECT_LT(thresholded_deg, plain_deg);
  EXPECT_LT(robust_deg, 0.75 * thresholded_deg);
  // Noise of 0.5 % over a dozen images leaves about this.
  EXPECT_LT(robust_deg, 1.0);
  EXPECT_LT(AlbedoErrorPercent(robust.albedo, picture.albedo), 2.0);
}

TEST(PhotometricStereo, UnknownStrengthsUpToOneFactor) {
  std::mt19937_64 rng = support::TestRng();
  StereoScene scene = PlainScene();
  scene.noise_sigma = 0.002;
  scene.strength = {1.0, 0.6, 1.3, 0.8, 1.1, 0.9, 1.5, 0.7};
  const StereoPicture picture = RenderStereo(scene, LightsAround(8), rng);
  const PhotometricStereo wrong = SolvePhotometricStereo(DataOf(picture), Only(StereoMethod::kRobust));
  const PhotometricStereo result =
      SolvePhotometricStereo(DataOf(picture), Only(StereoMethod::kRobustStrengths));
  EXPECT_GT(MeanAngleDeg(wrong.normal, picture.normal), 3);
  EXPECT_LT(MeanAngleDeg(result.normal, picture.normal), 0.5);
  EXPECT_LT(AlbedoErrorPercent(result.albedo, picture.albedo), 0.5);
  const Eigen::Map<const Eigen::VectorXd> truth(scene.strength.data(), 8);
  const Eigen::ArrayXd ratio = result.strength.array() / truth.array();
  EXPECT_LT((ratio / ratio.mean() - 1).abs().maxCoeff(), 0.005);
  EXPECT_NE(result.message.find("one common factor"), std::string::npos);
}

TEST(PhotometricStereo, CurveIsChosenOnlyWhereTheDataSupportIt) {
  std::mt19937_64 rng = support::TestRng();
  StereoScene scene = PlainScene();
  scene.noise_sigma = 0.004;
  const StereoPicture lambert = RenderStereo(scene, LightsAround(10), rng);
  EXPECT_EQ(SolvePhotometricStereo(DataOf(lambert)).curve.kind, CurveKind::kLambert);
  scene.exponent = 0.8;
  const StereoPicture curved = RenderStereo(scene, LightsAround(10), rng);
  const PhotometricStereo result = SolvePhotometricStereo(DataOf(curved));
  ASSERT_EQ(result.curve.kind, CurveKind::kExponent) << result.because;
  EXPECT_NEAR(std::exp(result.curve.parameters[0]), 0.8, 0.02);
  EXPECT_GE(result.scores.size(), 3U);
  const PhotometricStereo straight = SolvePhotometricStereo(DataOf(curved), Only(StereoMethod::kRobust));
  EXPECT_LT(MeanAngleDeg(result.normal, curved.normal), 0.5 * MeanAngleDeg(straight.normal, curved.normal));
}

// Directions that are off come back, but for a turn of all of them, which normals share.
TEST(PhotometricStereo, DirectionsAreAdjustedWithinTheirSigma) {
  std::mt19937_64 rng = support::TestRng();
  StereoScene scene = PlainScene();
  scene.noise_sigma = 0.001;  // little against what the directions' errors do to the albedo
  const StereoPicture picture = RenderStereo(scene, LightsAround(9), rng);
  StereoData data = DataOf(picture);
  constexpr double kSigma = 0.03;
  std::normal_distribution<double> off(0, kSigma);
  for (auto light : data.to_light.colwise()) {
    light += Eigen::Vector3d(off(rng), off(rng), off(rng));
    light.normalize();
  }
  const PhotometricStereo held = SolvePhotometricStereo(data, Only(StereoMethod::kRobust));
  data.direction_sigma_rad = Eigen::VectorXd::Constant(9, kSigma);
  const PhotometricStereo adjusted = SolvePhotometricStereo(data, Only(StereoMethod::kRobust));
  const double before = (data.to_light - picture.to_light).norm();
  EXPECT_LT((adjusted.to_light - picture.to_light).norm(), 0.7 * before);
  EXPECT_LT(AlbedoErrorPercent(adjusted.albedo, picture.albedo),
            0.6 * AlbedoErrorPercent(held.albedo, picture.albedo));
}

// Noise alone: the deviation over sigma is normal, so 95 % of the pixels lie within 2 sigma.
TEST(PhotometricStereo, SigmaCoversTheNoise) {
  std::mt19937_64 rng = support::TestRng();
  StereoScene scene = PlainScene();
  scene.noise_sigma = 0.01;
  const StereoPicture picture = RenderStereo(scene, LightsAround(12, 0.4), rng);
  const PhotometricStereo result = SolvePhotometricStereo(DataOf(picture), Only(StereoMethod::kRobust));
  const Eigen::ArrayXd z = (result.albedo - picture.albedo).array() / result.albedo_sigma.array();
  const double inside = static_cast<double>((z.abs() < 1.96).count()) / static_cast<double>(z.size());
  EXPECT_GT(inside, 0.90);
  EXPECT_LT(inside, 0.98);
  Eigen::ArrayXd angle(picture.normal.cols());
  for (Eigen::Index i = 0; i < angle.size(); ++i)
    angle[i] = std::acos(std::min(1.0, result.normal.col(i).dot(picture.normal.col(i))));
  const double ratio = std::sqrt((angle / result.normal_sigma_rad.array()).square().mean());
  EXPECT_GT(ratio, 0.85);
  EXPECT_LT(ratio, 1.15);
}

TEST(PhotometricStereo, LightsInOnePlaneDetermineNothing) {
  std::mt19937_64 rng = support::TestRng();
  Eigen::Matrix3Xd lights(3, 5);
  for (int k = 0; k < 5; ++k) lights.col(k) << std::sin(0.3 * (k - 2)), 0, std::cos(0.3 * (k - 2));
  const StereoPicture picture = RenderStereo(PlainScene(), lights, rng);
  const PhotometricStereo result = SolvePhotometricStereo(DataOf(picture));
  EXPECT_FALSE(result.IsUsable());
  EXPECT_NE(result.message.find("one plane"), std::string::npos) << result.message;
  EXPECT_TRUE(result.albedo.array().isNaN().all());
}

TEST(PhotometricStereo, PixelsWithTooFewValidImagesAreNaNAlone) {
  std::mt19937_64 rng = support::TestRng();
  StereoPicture picture = RenderStereo(PlainScene(), LightsAround(6, 0.25), rng);
  picture.value.col(0).tail(4).setConstant(NAN);
  const PhotometricStereo result = SolvePhotometricStereo(DataOf(picture));
  ASSERT_TRUE(result.IsUsable());
  EXPECT_TRUE(std::isnan(result.albedo[0]));
  EXPECT_TRUE(result.albedo.tail(result.albedo.size() - 1).allFinite());
  StereoData dark = DataOf(picture);
  dark.value.setZero();
  EXPECT_FALSE(SolvePhotometricStereo(dark).IsUsable());
}

TEST(PhotometricStereo, ShapesAreChecked) {
  StereoData data{Eigen::MatrixXd::Ones(4, 2), LightsAround(3), {}, {}};
  EXPECT_THROW(SolvePhotometricStereo(data), std::invalid_argument);
  data.to_light = 2 * LightsAround(4);
  EXPECT_THROW(SolvePhotometricStereo(data), std::invalid_argument);
}

// The classical set; the object is a sphere, which no solver knows.
TEST(PhotometricStereo, RealGreySphere) {
  const char* const folder = std::getenv("LUXFIT_REAL_DATA");
  if (folder == nullptr) GTEST_SKIP() << "set LUXFIT_REAL_DATA to the folder that holds gray-sphere";
  const support::GraySphere set = support::ReadGraySphere(std::string(folder) + "/gray-sphere");
  const support::GrayPixels pixels = support::PixelsOf(set);
  const StereoData data = support::WithMirrorSphereLights(set, pixels);
  const PhotometricStereo result = SolvePhotometricStereo(data);
  ASSERT_TRUE(result.IsUsable()) << result.message;
  const double off_deg = MeanAngleDeg(result.normal, pixels.normal),
               variation_percent = support::VariationPercent(result.albedo);
  std::printf("normals %.2f degrees, albedo varies by %.2f %%; curve: %s\n", off_deg, variation_percent,
              result.because.c_str());
  EXPECT_LT(off_deg, 4.0);
  EXPECT_LT(variation_percent, 5.0);
}

}  // namespace
}  // namespace luxfit
