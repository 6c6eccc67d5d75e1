#include "inverse/observe/camera/veiling_glare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace luxfit {
namespace {

struct VeiledPhotos {
  std::vector<Observation> observations;
  PictureMeans means;
  std::vector<int> camera_of_view;
};

// Returns the count of an element's light. `side` runs from 0 to 1 across the picture.
using Lens = std::function<double(double light, double mean, double side, int camera)>;

double Veil(double share, double light, double mean) { return light + share * mean; }

// Views of 300 elements in two states, with noise of 1 %, exposures up to 30 % off, and one element in twenty that a view sees as
// something else. Pictures hold the elements and luminaires: their means differ by up to a factor of two.
VeiledPhotos Draw(const std::vector<int>& camera_of_view, const Lens& lens, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  VeiledPhotos photos;
  photos.camera_of_view = camera_of_view;
  for (int state = 0; state < 2; ++state) {
    std::vector<double> light(300);
    for (double& l : light) l = std::exp(normal(rng));
    for (int view = 0; view < static_cast<int>(camera_of_view.size()); ++view) {
      const double gain = std::exp(0.3 * (2 * uniform(rng) - 1)), mean = 1.5 * (1 + uniform(rng));
      const int camera = camera_of_view[static_cast<size_t>(view)];
      double added = 0;
      for (int e = 0; e < 300; ++e) {
        double value = lens(light[static_cast<size_t>(e)], mean, uniform(rng), camera);
        added += (value - light[static_cast<size_t>(e)]) / 300;
        value *= gain * (1 + 0.01 * normal(rng));
        if (normal(rng) > 1.65) value *= 0.5;
        photos.observations.push_back(
            {e, view, state, 9, value, 1e-6, Eigen::Vector3d(value, 0.5 * value, 0), 0});
      }
      const double as_counted = gain * (mean + added);
      photos.means[{view, state}] = {as_counted, Eigen::Vector3d(as_counted, 0.5 * as_counted, 0)};
    }
  }
  return photos;
}

std::vector<std::optional<VeilingGlare>> FindVeil(const VeiledPhotos& photos, int cameras = 1) {
  return FindVeilingGlare(photos.observations, photos.means, photos.camera_of_view, cameras);
}

double Plain(double light, double, double, int) { return light; }

// The mean holds the veil: what is found is g / (1 + g).
TEST(VeilingGlareTest, ShareIsFound) {
  for (const double g : {0.005, 0.02, 0.06}) {
    const auto lens = [g](double light, double mean, double, int) { return Veil(g, light, mean); };
    const auto found = FindVeil(Draw({0, 0, 0, 0, 0, 0}, lens, 3))[0];
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->IsFound()) << g;
    EXPECT_NEAR(found->share, g / (1 + g), 4 * found->sigma + 0.01 * g);
    EXPECT_LT(found->sigma, 0.001);
    EXPECT_EQ(found->views, 6);
    EXPECT_LE(found->difference_without, found->difference);
  }
}

// Sixty draws. Five sigmas and 0.2 % leave no chance to noise, wrong exposures and things that only one view sees.
TEST(VeilingGlareTest, ClearLensesAreLeftAlone) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto found = FindVeil(Draw({0, 0, 0, 0, 0}, Plain, seed))[0];
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->IsFound()) << seed;
    squares += std::pow(found->share / found->sigma, 2) / 60;
  }
  EXPECT_LT(squares, 6) << "sigma is far too small";
}

TEST(VeilingGlareTest, DarkCornersAndACurveAreNoVeil) {
  const auto dark = [](double light, double, double side, int) { return light * (1 - 0.3 * side * side); };
  const auto curve = [](double light, double, double, int) { return std::pow(light, 0.7); };
  for (const Lens& lens : {Lens(dark), Lens(curve)}) {
    const auto found = FindVeil(Draw({0, 0, 0, 0, 0, 0}, lens, 4))[0];
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->IsFound());
  }
}

TEST(VeilingGlareTest, OneCameraOfTwo) {
  const auto lens = [](double light, double mean, double, int camera) {
    return Veil(camera == 1 ? 0.03 : 0, light, mean);
  };
  const auto found = FindVeil(Draw({0, 1, 0, 1, 0, 1, 0, 1}, lens, 5), 2);
  ASSERT_TRUE(found[0] && found[1]);
  EXPECT_FALSE(found[0]->IsFound());
  EXPECT_TRUE(found[1]->IsFound());
}

TEST(VeilingGlareTest, TwoViewsAreNotJudged) {
  EXPECT_FALSE(FindVeil(Draw(
      {0, 0}, [](double l, double m, double, int) { return Veil(0.05, l, m); }, 6))[0]);
}

TEST(VeilingGlareTest, VeilIsTakenOut) {
  const PictureMeans means = {{{0, 0}, {2, {2, 1, 0.5}}}};
  const std::vector<Observation> observations = {{0, 0, 0, 9, 1.0, 1e-4, {1, 0.5, 0.25}, 0},
                                                 {1, 0, 0, 9, 0.1, 1e-4, {0.1, 0.1, 0.1}, 0}};
  VeilingGlare veil;
  veil.share = 0.03, veil.sigma = 0.005;
  const auto left = WithoutVeils(observations, means, {0}, {veil});
  ASSERT_EQ(left.size(), 1u) << "the other one is mostly veil";
  EXPECT_DOUBLE_EQ(left[0].relative_luminance, 0.94);
  EXPECT_TRUE(left[0].relative_rgb.isApprox(Eigen::Vector3d(0.94, 0.47, 0.235), 1e-12));
  EXPECT_DOUBLE_EQ(left[0].variance, 2e-4);
  veil.sigma = 0.01;  // three sigmas
  EXPECT_EQ(WithoutVeils(observations, means, {0}, {veil}).size(), 2u);
}

TEST(VeilingGlareTest, MeanIsOfFinitePixels) {
  LuminanceImage image;
  image.relative_luminance = ImagePlane::Constant(2, 2, 3);
  image.relative_luminance(1, 1) = std::numeric_limits<float>::infinity();
  image.relative_rgb = {image.relative_luminance, 2 * image.relative_luminance, image.relative_luminance};
  const PictureMean mean = PictureMeanOf(image);
  EXPECT_DOUBLE_EQ(mean.relative_luminance, 3);
  EXPECT_DOUBLE_EQ(mean.relative_rgb[1], 6);
}

}  // namespace
}  // namespace luxfit
