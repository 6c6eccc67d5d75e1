#include "inverse/choose/internal/scene_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "inverse/choose/internal/colour_detail.h"
#include "inverse/model/internal/light_model.h"
#include "tests/support/closed_forms.h"
#include "tests/support/inverse/box_paths.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kNoise = 0.005;
const Eigen::Vector3d kSize(4, 3, 2.5);

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
    room_ =
        MakeRoom(support::ClosedRoom(kSize, {"west", "east", "south", "north", "floor", "ceiling"}), options);
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

  void PhotographGrey(double albedo) {
    Photograph(Eigen::Matrix3Xd::Constant(3, 6, albedo), Eigen::Matrix<double, 3, 2>::Constant(1000));
  }

  std::mt19937_64 rng_ = support::TestRng();
  Eigen::Vector3d luminance_weights_ = Eigen::Vector3d::Constant(1.0 / 3);
  Room room_ = MakeRoom(Scene{});
  LightData data_;
  LuminaireFit fit_;
};

TEST_F(FittedRoom, BlackNeedsNoReflection) {
  Make(0.5, 0.25, true);
  PhotographGrey(0.001);
  const SceneDetail detail = CompareDetail(room_, data_, fit_);
  ASSERT_TRUE(detail.is_compared);
  EXPECT_EQ(detail.bounces.Chosen().name, "0");
}

// Even a black floor is all that a ceiling gets its light from.
TEST_F(FittedRoom, BlackUnderDownlightsNeedsOneReflection) {
  Make(0.5, 0.25);
  PhotographGrey(0.005);
  EXPECT_EQ(CompareDetail(room_, data_, fit_).bounces.Chosen().name, "1");
}

constexpr int kMostReflections = 3;
using LightByOrder = Eigen::Matrix<double, kMostReflections + 1, 2>;

// Returns the light of Lambertian points at a place, direct and by the number of reflections, reflections x points.
// Paths: the mean over them of rho^k D(x_k). The first directions lie one in each cell of a grid.
LightByOrder PathLight(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                       const std::vector<Luminaire>& points, double rho, std::mt19937_64& rng) {
  constexpr int kSide = 24;
  std::uniform_real_distribution<double> unit;
  LightByOrder light = LightByOrder::Zero();
  const auto add = [&](int order, double weight, const Eigen::Vector3d& at, const Eigen::Vector3d& facing) {
    for (int k = 0; k < 2; ++k) {
      const Luminaire& point = points[static_cast<size_t>(k)];
      light(order, k) +=
          weight * support::PointLx(point.flux_lm, support::LambertianCdPerLm, point.position, at, facing);
    }
  };
  add(0, 1, p, normal);
  for (int cell = 0; cell < kSide * kSide; ++cell) {
    Eigen::Vector3d at = p, facing = normal;
    double weight = 1.0 / (kSide * kSide), radial = (cell / kSide + unit(rng)) / kSide,
           azimuthal = (cell % kSide + unit(rng)) / kSide;
    for (int order = 1; order <= kMostReflections; ++order) {
      std::tie(at, facing) = support::HitBox(kSize, at, support::CosineWeighted(facing, radial, azimuthal));
      weight *= rho;
      add(order, weight, at, facing);
      radial = unit(rng), azimuthal = unit(rng);
    }
  }
  return light;
}

// The photos show so many reflections and no more, in a white room, where each of them is a large part of the light.
// One more or less changes the contrast of floor and walls by 4 % and more; the paths scatter by 1 to 2 %.
TEST_F(FittedRoom, ReflectionsThatTheLightHasAreCounted) {
  constexpr double kRho = 0.85, kPathNoise = 0.02;
  Make(0.5, 0.25);
  PhotographGrey(kRho);
  std::vector<LightByOrder> light;
  light.reserve(room_.patches.elements.size());
  for (const Element& element : room_.patches.elements)
    light.push_back(PathLight(element.center, element.normal, fit_.state.luminaires, kRho, rng_));
  for (int reflections = 1; reflections <= kMostReflections; ++reflections) {
    for (Observation& o : data_.observations) {
      const double lx = light[static_cast<size_t>(o.element)].col(o.state).head(reflections + 1).sum();
      o.relative_luminance = fit_.state.camera_scale * kRho / support::kPi * lx;
      o.variance = std::pow(kPathNoise * o.relative_luminance, 2);
    }
    const SceneDetail detail = CompareDetail(room_, data_, fit_);
    ASSERT_TRUE(detail.is_compared);
    EXPECT_EQ(detail.bounces.Chosen().name, std::to_string(reflections));
  }
}

TEST_F(FittedRoom, WhiteNeedsAll) {
  Make(0.5, 0.25);
  PhotographGrey(0.85);
  const SceneDetail detail = CompareDetail(room_, data_, fit_);
  EXPECT_EQ(detail.bounces.Chosen().name, "all");
  ASSERT_EQ(detail.bounces.among.size(), 6u);
  // Each reflection brings it nearer.
  for (size_t n = 1; n < 6; ++n)
    EXPECT_LE(detail.bounces.among[n].score, detail.bounces.among[n - 1].score + 0.01) << n;
}

TEST_F(FittedRoom, CoarseElementsAreSaid) {
  Make(0.4, 0.1);
  PhotographGrey(0.5);
  const SceneDetail fine = CompareDetail(room_, data_, fit_);
  EXPECT_TRUE(fine.IsFineEnough()) << fine.patch_error << ' ' << fine.element_error;
  EXPECT_NEAR(fine.element_size_m, 0.1, 0.01);
  Make(1.5, 0.75);
  PhotographGrey(0.5);
  const SceneDetail coarse = CompareDetail(room_, data_, fit_);
  EXPECT_FALSE(coarse.IsFineEnough()) << coarse.patch_error << ' ' << coarse.element_error;
  EXPECT_EQ(coarse.elements.Chosen().name, "as used");
}

// The error that is predicted of elements twice as large is the one that such elements have: their direct
// light at the centre against the mean over them, by the model of a finer mesh.
TEST_F(FittedRoom, ElementErrorIsThatOfFinerOnes) {
  Make(0.5, 0.5, true);
  PhotographGrey(0.005);
  const SceneDetail coarse = CompareDetail(room_, data_, fit_);
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
  EXPECT_FALSE(CompareDetail(room_, data_, fit_).is_compared);
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

}  // namespace
}  // namespace luxfit
