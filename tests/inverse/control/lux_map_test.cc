// lux_map.h and dimming.h on numbers that can be had by hand.
#include "inverse/control/lux_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "forward/light/room.h"
#include "inverse/control/dimming.h"
#include "inverse/model/fit_uncertainty.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;

Patches TwoMaterials() {
  const Eigen::Vector3d o = Eigen::Vector3d::Zero(), x = Eigen::Vector3d::UnitX(),
                        y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  Patches patches;
  for (int i = 0; i < 2; ++i) {
    patches.patches.push_back({o, o, x, y, 1, true, 0, i, i, 1});
    patches.elements.push_back({o, z, o, x, y, 1, true, i});
  }
  return patches;
}

LuminanceImage FlatImage(float y) {
  LuminanceImage image;
  image.relative_luminance = ImagePlane::Constant(1, 4, y);
  image.relative_rgb = {image.relative_luminance, image.relative_luminance, image.relative_luminance};
  image.valid = PixelMask::Constant(1, 4, true);
  image.saturated = PixelMask::Constant(1, 4, false);
  return image;
}

SurfaceScale Scale() {
  SurfaceScale scale;
  scale.camera_scale = 0.1;
  scale.albedo = Eigen::Vector2d(0.5, 0.2);
  scale.relative_sigma = Eigen::Vector2d(0.03, std::numeric_limits<double>::quiet_NaN());
  scale.relative_model_sigma = 0.04;
  return scale;
}

TEST(LuxMap, IlluminanceIsPiLOverRhoAndUnknownPixelsSayWhy) {
  PixelMap map;
  map.element.resize(1, 4);
  map.element << 0, 1, -1, 0;
  LuminanceImage image = FlatImage(0.7F);
  image.saturated(0, 3) = true;
  image.valid(0, 3) = false;
  const LuxMap lux = MapIlluminance(map, image, TwoMaterials(), Scale());
  EXPECT_NEAR(lux.illuminance_lx(0, 0), kPi * 0.7 / (0.1 * 0.5), 1e-4);
  EXPECT_NEAR(lux.sigma_lx(0, 0) / lux.illuminance_lx(0, 0), 0.05, 1e-6);  // 3 and 4 % in quadrature
  for (int u = 1; u < 4; ++u) EXPECT_TRUE(std::isnan(lux.illuminance_lx(0, u))) << u;
  EXPECT_EQ(lux.gap(0, 0), 0);
  EXPECT_EQ(lux.gap(0, 1), static_cast<float>(PixelGap::kReflectanceUnknown));
  EXPECT_EQ(lux.gap(0, 2), static_cast<float>(PixelGap::kNoSurface));
  EXPECT_EQ(lux.gap(0, 3), static_cast<float>(PixelGap::kSaturated));
  EXPECT_NEAR(lux.known_share, 0.25, 1e-12);
  EXPECT_NEAR(lux.saturated_share, 1.0 / 3, 1e-12);
}

// var(ln c rho) = var(ln c) + 2 cov(ln c, rho) / rho + var(rho) / rho^2.
TEST(LuxMap, TheProductOfScaleAndReflectanceIsKnownBetterThanEither) {
  const ParameterId camera{ParameterKind::kLogCameraScale, ""}, wall{ParameterKind::kAlbedo, "wall"};
  FitUncertainty fit;
  fit.parameters = {camera, wall};
  fit.is_determined = {true, true};
  fit.covariance = Eigen::Vector2d(4e-4, 1e-4).asDiagonal();
  fit.covariance(0, 1) = fit.covariance(1, 0) = -1.8e-4;
  fit.relative_model_sigma = 0.01;
  const FittedSurfaces surfaces{
      {"wall", "given", "unseen"}, Eigen::Vector3d(0.5, 0.3, 0.2), {true, true, false}};
  const SurfaceScale scale = ScaleOfSurfaces(2.5, surfaces, fit);
  EXPECT_NEAR(scale.relative_sigma[0], std::sqrt(4e-4 - 2 * 1.8e-4 / 0.5 + 1e-4 / 0.25), 1e-12);  // rounding
  EXPECT_DOUBLE_EQ(scale.relative_sigma[1], 0.02);  // the scale's alone
  EXPECT_TRUE(std::isnan(scale.relative_sigma[2]));
  EXPECT_EQ(scale.camera_scale, 2.5);
  EXPECT_EQ(scale.relative_model_sigma, 0.01);
  EXPECT_THROW(ScaleOfSurfaces(1, {{"wall"}, {}, {}}, fit), std::invalid_argument);
}

TEST(LuxMap, RefusesACameraWithoutScale) {
  SurfaceScale scale = Scale();
  scale.camera_scale = 0;
  PixelMap map;
  map.element = decltype(map.element)::Zero(1, 4);
  EXPECT_THROW(MapIlluminance(map, FlatImage(1), TwoMaterials(), scale), std::invalid_argument);
}

class Dimmed : public testing::Test {
 protected:
  Dimmed() : light_(400, 3), rng_(support::TestRng()) {
    std::uniform_real_distribution<double> uniform(0, 100);
    for (double& e : light_.reshaped()) e = uniform(rng_);
  }
  std::vector<ElementIlluminance> Measure(const Eigen::Vector3d& dimming, double daylight_lx, double noise) {
    std::normal_distribution<double> normal;
    std::vector<ElementIlluminance> measured;
    for (int e = 0; e < light_.rows(); ++e) {
      const double lx = light_.row(e).dot(dimming) + daylight_lx;
      measured.push_back({e, 10, lx * (1 + noise * normal(rng_)), 0.05 * lx, noise * lx});
    }
    return measured;
  }
  Eigen::MatrixXd light_;
  std::mt19937_64 rng_;
};

TEST_F(Dimmed, DimmingIsFoundAndOffIsOff) {
  const CurrentDimming current = EstimateDimming(light_, Measure({0.3, 0, 1}, 0, 0.01));
  ASSERT_TRUE(current.is_determined);
  // The normal equations of 400 elements of 1.4 % (noise and the least error of the model), of which 25 count as one,
  // give 0.0043, 0.0025 and 0.0061. The limits are 1.5 times that.
  const Eigen::Vector3d truth(0.3, 0, 1), most_sigma(0.0065, 0.0038, 0.0092);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double sigma = std::sqrt(current.covariance(k, k));
    std::printf("luminaire %d: dimming %.4f, sigma %.4f\n", static_cast<int>(k), current.dimming[k], sigma);
    EXPECT_NEAR(current.dimming[k], truth[k], 4 * sigma) << k;
    EXPECT_LT(sigma, most_sigma[k]) << k;
  }
  EXPECT_LT(current.unexplained_share, 0.02);
}

TEST_F(Dimmed, DaylightIsSaidToBeUnexplainedAndWidensWhatIsPredicted) {
  const CurrentDimming dark = EstimateDimming(light_, Measure({0.3, 0, 1}, 0, 0.01));
  const CurrentDimming day = EstimateDimming(light_, Measure({0.3, 0, 1}, 80, 0.01));
  EXPECT_GT(day.unexplained_share, 5 * dark.unexplained_share);
  const Eigen::MatrixXd place = Eigen::RowVector3d(50, 50, 50);
  const Eigen::Matrix3d flux = 4e-4 * Eigen::Matrix3d::Identity();
  EXPECT_GT(LightByDimming(place, day, flux, 0.01)[0].sigma_lx,
            LightByDimming(place, dark, flux, 0.01)[0].sigma_lx);
  EXPECT_NEAR(LightByDimming(place, dark, flux, 0.01)[0].illuminance_lx, 65, 1.5);
}

TEST_F(Dimmed, TooFewElementsDetermineNothing) {
  std::vector<ElementIlluminance> few = Measure({1, 1, 1}, 0, 0.01);
  few.resize(3);
  EXPECT_FALSE(EstimateDimming(light_, few).is_determined);
}

// One person, two luminaires out of view that give 80 and 20 lx: a drop of 10 % is 10 lx, so that the second
// can halve by itself, the first go down an eighth.
TEST(UnseenDimming, ADropAtTheEyeIsSharedAsPowerAsks) {
  EyeLight eyes{Eigen::RowVector2d(80, 20), Eigen::Array<bool, 1, 2>(false, false)};
  const UnseenDimming unseen =
      DimUnseen(eyes, Eigen::Vector2d(1, 1), Eigen::Vector2d(30, 30), 0.1, Eigen::Matrix2d::Zero());
  EXPECT_NEAR(unseen.alone[0], 0.875, 1e-9);
  EXPECT_NEAR(unseen.alone[1], 0.5, 1e-9);
  // The second gives less light to the eye for its power: it goes first.
  EXPECT_NEAR(unseen.dimming[0], 1, 1e-6);
  EXPECT_NEAR(unseen.dimming[1], 0.5, 1e-6);
  EXPECT_NEAR(unseen.drop[0], 0.1, 1e-6);
}

TEST(UnseenDimming, ALuminaireInViewDimsByTheDropAtMost) {
  EyeLight eyes{Eigen::RowVector2d(80, 1), Eigen::Array<bool, 1, 2>(false, true)};
  const UnseenDimming unseen =
      DimUnseen(eyes, Eigen::Vector2d(1, 1), Eigen::Vector2d(30, 30), 0.1, Eigen::Matrix2d::Zero());
  EXPECT_NEAR(unseen.alone[1], 0.9, 1e-9);
  EXPECT_GE(unseen.dimming[1], 0.9 - 1e-9);
}

TEST(UnseenDimming, TheUncertaintyOfADropIsThatOfTheRatio) {
  EyeLight eyes{Eigen::RowVector2d(80, 20), Eigen::Array<bool, 1, 2>(false, false)};
  const Eigen::Vector2d now(1, 1), power(30, 30);
  // A factor that all fluxes share changes no ratio.
  const Eigen::Matrix2d common = Eigen::Matrix2d::Constant(4e-4);
  EXPECT_NEAR(DimUnseen(eyes, now, power, 0.1, common).drop_sigma[0], 0, 1e-9);
  const double step = 1e-4;
  const UnseenDimming unseen = DimUnseen(eyes, now, power, 0.1, 4e-4 * Eigen::Matrix2d::Identity());
  const auto drop = [&](const Eigen::Vector2d& light) {
    return 1 - light.dot(unseen.dimming) / light.dot(now);
  };
  Eigen::Vector2d gradient;
  for (Eigen::Index k = 0; k < 2; ++k) {
    Eigen::Vector2d more(80, 20), less = more;
    more[k] *= std::exp(step);
    less[k] *= std::exp(-step);
    gradient[k] = (drop(more) - drop(less)) / (2 * step);
  }
  EXPECT_NEAR(unseen.drop_sigma[0], 0.02 * gradient.norm(), 1e-7);
}

TEST(UnseenDimming, InViewIsWithinTheFieldAndNotHidden) {
  Scene scene;
  scene.materials = {"screen"};
  scene.facets = FacetsFromPolygon({{1, -1, 0}, {1, 1, 0}, {1, 1, 1.5}, {1, -1, 1.5}}, 0);
  const RayScene rays(scene);
  Luminaire luminaire;
  luminaire.position = {2, 0, 2.5};
  const Gaze seen{"seen", {0, 0, 1.2}, {1, 0, 0}};  // 33 degrees up, above the screen
  EXPECT_TRUE(IsInView(rays, luminaire, seen));
  EXPECT_FALSE(IsInView(rays, luminaire, {"behind", seen.eye_m, {-1, 0, 0}}));
  luminaire.position = {2, 0, 1.4};
  EXPECT_FALSE(IsInView(rays, luminaire, seen));  // behind the screen
  luminaire.position = {2, 0, 1.0};
  EXPECT_FALSE(
      IsInView(rays, luminaire, {"above", {3, 0, 2}, {-1, 0, -1}}));  // shines down, away from the eye
}

}  // namespace
}  // namespace luxfit
