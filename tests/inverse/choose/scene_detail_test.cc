#include "inverse/choose/internal/detail/scene_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "inverse/choose/internal/detail/colour_detail.h"
#include "inverse/model/internal/light_model.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/cube_photos.h"
#include "tests/support/inverse/direct_photos.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kNoise = 0.005;
const Eigen::Vector3d kBoxSize(4, 3, 2.5);

// A room of 4 m x 3 m x 2.5 m with a different material on each side and two luminaires, as a converged fit
// leaves it: what is observed is what is modelled, with noise.
class FittedRoom : public testing::Test {
 protected:
  // `isotropic`: lit straight on all sides; else the ceiling has what is reflected alone.
  void Make(double patch_size_m, double element_size_m, bool isotropic = false) {
    fit_ = {};
    RoomOptions options;
    options.patches.patch_size_m = patch_size_m;
    options.patches.element_size_m = element_size_m;
    room_ = MakeRoom(support::ClosedRoom(kBoxSize, {"west", "east", "south", "north", "floor", "ceiling"}),
                     options);
    data_.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
    for (int k = 0; k < 2; ++k) {
      Luminaire luminaire;
      luminaire.position = {k == 0 ? 1.2 : 2.9, k == 0 ? 1.1 : 1.8, isotropic ? 1.3 : 2.4};
      luminaire.distribution = isotropic ? Distribution::kIsotropic : Distribution::kLambertian;
      luminaire.flux_lm = 1000;
      fit_.state.luminaires.push_back(luminaire);
    }
    fit_.state.free.resize(2);
    fit_.state.albedo_free.assign(6, true);
    fit_.status = FitStatus::kConverged;
    fit_.relative_sigma = kNoise;
  }

  // Luminance of every element in both states, luminaires of that flux.
  Eigen::VectorXd Light(const Eigen::VectorXd& albedo, const Eigen::Vector2d& flux) const {
    LightState state = fit_.state;
    state.albedo = albedo;
    for (size_t k = 0; k < 2; ++k) state.luminaires[k].flux_lm = flux[static_cast<Eigen::Index>(k)];
    LightModel model(room_, data_);
    model.FreezeVisibility(state);
    return model.Predict(state, {}, false).value;
  }

  // `albedo_rgb`: of every material; `flux_rgb`: of every luminaire, channels x luminaires.
  void Photograph(const Eigen::Matrix3Xd& albedo_rgb, const Eigen::Matrix<double, 3, 2>& flux_rgb) {
    data_.observations.clear();
    for (int e = 0; e < static_cast<int>(room_.patches.elements.size()); ++e) {
      for (int state = 0; state < 2; ++state)
        data_.observations.push_back({e, -1, state, 100, 1, 0, Eigen::Vector3d::Ones(), 0});
    }
    std::normal_distribution<double> noise(0, kNoise);
    fit_.state.albedo = albedo_rgb.transpose() * luminance_weights_;
    fit_.predicted = Light(fit_.state.albedo, flux_rgb.transpose() * luminance_weights_);
    fit_.weight = Eigen::VectorXd::Ones(fit_.predicted.size());
    std::array<Eigen::VectorXd, 3> channels;
    for (int c = 0; c < 3; ++c) channels[static_cast<size_t>(c)] = Light(albedo_rgb.row(c), flux_rgb.row(c));
    for (size_t i = 0; i < data_.observations.size(); ++i) {
      Observation& o = data_.observations[i];
      const Eigen::Index row = static_cast<Eigen::Index>(i);
      const double factor = 1 + noise(rng_);
      // A pose's error is that of all channels.
      for (int c = 0; c < 3; ++c) o.relative_rgb[c] = factor * channels[static_cast<size_t>(c)][row];
      o.relative_luminance = o.relative_rgb.dot(luminance_weights_);
      o.variance = std::pow(kNoise * o.relative_luminance, 2);
    }
  }

  // Returns a fit to the photos from where they were made, with the camera's scale known.
  LuminaireFit Fit() const {
    LightState start = fit_.state;
    start.camera_scale_free = false;
    return FitLuminaires(room_, data_, start);
  }

  void PhotographGrey(double albedo) {
    Photograph(Eigen::Matrix3Xd::Constant(3, 6, albedo), Eigen::Matrix<double, 3, 2>::Constant(1000));
  }

  std::mt19937_64 rng_ = support::TestRng();
  Eigen::Vector3d luminance_weights_ = Eigen::Vector3d::Constant(1.0 / 3);
  Room room_ = MakeRoom(Scene{});
  LightData data_;
  LuminaireFit fit_;
};

// An isotropic point of 1 lm in a cube of 2 m, which photos show by closed forms.
class PointInCube : public testing::Test {
 protected:
  explicit PointInCube(const Eigen::Vector3d& lamp = {0.9, 1.1, 0.95}) : lamp_(lamp) {
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    state_.luminaires.resize(1);
    state_.luminaires[0].id = "A";
    state_.luminaires[0].distribution = Distribution::kIsotropic;
    state_.luminaires[0].position = lamp_;
    state_.free.resize(1);
    state_.camera_scale_free = false;
    options_.subtracts_discretisation = false;
    options_.robust_sigmas = 100;  // a robust weight would follow the very light that is left out
  }

  // Frees the flux alone, and shows the cube of that reflectance.
  void ShowCube(const Room& cube, double rho) {
    data_.observations = support::CubePhotos(cube, lamp_, Eigen::Vector3d::Constant(rho));
    state_.albedo = Eigen::VectorXd::Constant(1, rho);
    state_.albedo_free = {false};
    state_.free[0].position = false;
  }

  LuminaireFit FitIn(const Room& room) const { return FitLuminaires(room, data_, state_, {}, options_); }

  const Eigen::Vector3d lamp_;
  LightData data_;
  LightState state_;
  FitLuminairesOptions options_;
};

TEST_F(PointInCube, BlackNeedsNoReflection) {
  const Room cube = support::CubeRoom();
  ShowCube(cube, 1e-6);
  const SceneDetail detail = CompareDetail(cube, data_, FitIn(cube), {});
  ASSERT_TRUE(detail.is_compared);
  EXPECT_EQ(detail.bounces.Chosen().name, "0");
}

// The light that n reflections leave out is rho^n of all reflected light, as in an integrating sphere. Without it the flux
// takes its share of the photos, in the mean over them. In a cube, reflected light is even to a tenth.
TEST_F(PointInCube, ReflectionsLeftOutMoveTheFluxByTheirShare) {
  constexpr double kRho = 0.5;
  const Room cube = support::CubeRoom();
  ShowCube(cube, kRho);
  const LuminaireFit fit = FitIn(cube);
  ASSERT_EQ(fit.parameters.size(), 1u);
  const SceneDetail detail = CompareDetail(cube, data_, fit, {});
  double share = 0;
  for (const Observation& o : data_.observations)
    share += kRho / support::kPi * support::CubeIndirectLx(kRho) / o.relative_luminance;
  share /= static_cast<double>(data_.observations.size());
  ASSERT_EQ(detail.bounces.among.size(), 6u);
  for (size_t n = 0; n < 5; ++n) {
    const LargestShift& effect = detail.bounces.among[n].effect;
    const double shift = effect.sigmas * std::sqrt(fit.covariance(0, 0)),
                 expected = share * std::pow(kRho, n);
    std::printf("%zu reflections: log flux moves by %.4f, expected %.4f\n", n, shift, expected);
    EXPECT_NEAR(shift, expected, 0.1 * expected);
    EXPECT_EQ(effect.parameter, fit.parameters[0].id());
  }
  EXPECT_EQ(detail.bounces.among.back().effect.sigmas, 0);
  EXPECT_EQ(detail.bounces.Chosen().name, "all");
}

// Photos show the means over their elements, by the solid angle. The fit to elements twice as large is another fit to
// other means. The next order of the error is (0.2 m / 0.5 m)^2 = 0.16 of it.
TEST_F(PointInCube, LargerElementsMoveTheFitAsPredicted) {
  constexpr double kRho = 0.5;
  const Eigen::Vector3d low(1.06, 0.94, 0.5);
  const Room room = MakeRoom(support::ClosedRoom({2, 2, 2}), {{0.4, 0.1}, {16}}),
             larger = MakeRoom(support::ClosedRoom({2, 2, 2}), {{0.4, 0.2}, {16}});
  state_.luminaires[0].position = low;
  state_.free[0].flux = false;
  state_.albedo = Eigen::VectorXd::Constant(1, kRho);
  state_.albedo_free = {true};
  data_.indirect_is_held = true;
  data_.observations = support::DirectPhotos(larger, low, kRho);
  const LuminaireFit coarse = FitIn(larger);
  data_.observations = support::DirectPhotos(room, low, kRho);
  const LuminaireFit fit = FitIn(room);
  const EffectChoice elements = CompareDetail(room, data_, fit, {}).elements;
  const LargestShift actual = LargestShiftOf(
      fit, PackParameters(coarse.state, fit.parameters) - PackParameters(fit.state, fit.parameters));
  const LargestShift& predicted = elements.among.front().effect;
  std::printf("twice the size moves %s by %.3f sigma, predicted %.3f\n", NameOf(actual.parameter).c_str(),
              actual.sigmas, predicted.sigmas);
  EXPECT_EQ(predicted.parameter, actual.parameter);
  EXPECT_NEAR(predicted.sigmas, actual.sigmas, 0.2 * actual.sigmas);
  EXPECT_DOUBLE_EQ(elements.among.back().effect.sigmas, predicted.sigmas / 3);
}

TEST(ChooseByEffect, TakesTheCoarsestBelowATenth) {
  const auto candidate = [](const char* name, double sigmas) {
    return EffectCandidate{name, LargestShift{sigmas, {}}};
  };
  EXPECT_EQ(ChooseByEffect({candidate("0", 3), candidate("1", 0.09), candidate("2", 0.01)}).Chosen().name,
            "1");
  EXPECT_EQ(ChooseByEffect({candidate("twice as large", 0.3), candidate("as used", 0.1)}).Chosen().name,
            "as used");
}

TEST_F(FittedRoom, CoarseElementsAreSaid) {
  Make(0.4, 0.1);
  PhotographGrey(0.5);
  const SceneDetail fine = CompareDetail(room_, data_, Fit(), {});
  EXPECT_TRUE(fine.IsFineEnough()) << fine.patch_error << ' ' << fine.element_error;
  EXPECT_NEAR(fine.element_size_m, 0.1, 0.01);
  Make(1.5, 0.75);
  PhotographGrey(0.5);
  const SceneDetail coarse = CompareDetail(room_, data_, Fit(), {});
  EXPECT_FALSE(coarse.IsFineEnough()) << coarse.patch_error << ' ' << coarse.element_error;
  EXPECT_EQ(coarse.elements.Chosen().name, "as used");
}

// The error that is predicted of elements twice as large is the one that such elements have: their direct
// light at the centre against the mean over them, by the model of a finer mesh.
TEST_F(FittedRoom, ElementErrorIsThatOfFinerOnes) {
  Make(0.5, 0.5, true);
  PhotographGrey(0.005);
  fit_.state.albedo_free.assign(6, false);  // darker than a fit lets them be
  const SceneDetail coarse = CompareDetail(room_, data_, Fit(), {});
  const Eigen::VectorXd at_centres = fit_.predicted;
  const Patches large = room_.patches;
  Make(0.5, 0.0625, true);
  PhotographGrey(0.005);
  std::map<std::pair<int, int>, std::pair<double, int>> means;
  for (size_t i = 0; i < data_.observations.size(); ++i) {
    const Element& small = room_.patches.elements[static_cast<size_t>(data_.observations[i].element)];
    const int facet = room_.patches.patches[static_cast<size_t>(small.patch)].facet;
    const Eigen::Vector2d at = room_.scene.facets[static_cast<size_t>(facet)].CoordinatesOf(small.center);
    auto& [sum, count] = means[{large.ElementAt(facet, at.x(), at.y()), data_.observations[i].state}];
    sum += fit_.predicted[static_cast<Eigen::Index>(i)];
    ++count;
  }
  std::vector<double> errors;
  for (const auto& [key, mean] : means) {
    const double centre = at_centres[2 * key.first + key.second];
    errors.push_back(std::abs(mean.first / mean.second / centre - 1));
  }
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  EXPECT_NEAR(coarse.element_error, 1.4826 * errors[errors.size() / 2], 0.25 * coarse.element_error);
}

TEST_F(FittedRoom, NothingIsComparedWithoutPhotos) {
  Make(0.5, 0.25);
  fit_.state.albedo = Eigen::VectorXd::Constant(6, 0.5);
  EXPECT_FALSE(CompareDetail(room_, data_, fit_, {}).is_compared);
  EXPECT_TRUE(CompareColours(room_, data_, fit_).luminaires.among.empty());
}

TEST_F(FittedRoom, GreyAndColouredMaterialsAreToldApart) {
  Make(0.5, 0.25);
  Eigen::Matrix3Xd albedo = Eigen::Matrix3Xd::Constant(3, 6, 0.5);
  albedo.col(0) = Eigen::Vector3d(0.55, 0.5, 0.45);
  albedo.col(4) = Eigen::Vector3d(0.2, 0.3, 0.25);
  Photograph(albedo, Eigen::Matrix<double, 3, 2>::Constant(1000));
  const ColourDetail colours = CompareColours(room_, data_, fit_);
  for (size_t m = 0; m < 6; ++m) {
    ASSERT_FALSE(colours.materials[m].among.empty()) << m;
    EXPECT_EQ(colours.materials[m].Chosen().name, m == 0 || m == 4 ? "coloured" : "grey") << m;
  }
  EXPECT_EQ(colours.luminaires.Chosen().name, "alike");
}

TEST_F(FittedRoom, LuminairesOfTwoColoursAreToldApart) {
  Make(0.5, 0.25);
  Eigen::Matrix<double, 3, 2> flux;
  flux << 1050, 950, 1000, 1000, 950, 1050;
  Photograph(Eigen::Matrix3Xd::Constant(3, 6, 0.3), flux);
  const ColourDetail colours = CompareColours(room_, data_, fit_);
  EXPECT_EQ(colours.luminaires.Chosen().name, "each its own");
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(colours.tint(c, k), flux(c, k) / 1000, 0.01) << c << k;
  }
}

TEST_F(FittedRoom, AWarmLuminaireKeepsItsLuminance) {
  Make(0.5, 0.25);
  luminance_weights_ = {0.265, 0.67, 0.065};
  const Eigen::Vector3d warm(1.1, 1, 0.592);  // its luminance is 1, its mean is not
  Eigen::Matrix<double, 3, 2> flux = Eigen::Matrix<double, 3, 2>::Constant(1000);
  flux.col(1) = 1000 * warm;
  Photograph(Eigen::Matrix3Xd::Constant(3, 6, 0.3), flux);
  const ColourDetail colours = CompareColours(room_, data_, fit_);
  EXPECT_EQ(colours.luminaires.Chosen().name, "each its own");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(colours.tint(c, 1) / colours.tint(c, 0), warm[c], 0.015) << c;
}

// Red walls colour what a grey surface reflects. The floor has light of the luminaires in it, the ceiling has none.
TEST_F(FittedRoom, ANeutralSurfaceTellsTheLightOfLuminairesThatLightIt) {
  constexpr int kFloor = 4, kCeiling = 5;
  Make(0.5, 0.25);
  const Eigen::Vector3d warm(1.2, 1, 0.8);
  Eigen::Matrix3Xd albedo = Eigen::Matrix3Xd::Constant(3, 6, 0.5);
  for (int wall = 0; wall < 4; ++wall) albedo.col(wall) = Eigen::Vector3d(0.7, 0.5, 0.3);
  Photograph(albedo, 1000 * warm.replicate<1, 2>());
  const ColourDetail by_floor = CompareColours(room_, data_, fit_, {kFloor});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(by_floor.neutral_light[c], warm[c], 0.005) << c;
    EXPECT_LT(by_floor.neutral_light_sigma[c], 0.005) << c;
  }
  EXPECT_TRUE(CompareColours(room_, data_, fit_, {kCeiling}).neutral_light.array().isNaN().all());
  EXPECT_TRUE(CompareColours(room_, data_, fit_).neutral_light.array().isNaN().all());
}

}  // namespace
}  // namespace luxfit
