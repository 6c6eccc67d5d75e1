#include "inverse/observe/camera/tone_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace luxfit {
namespace {

struct Photos {
  std::vector<Observation> observations;
  std::vector<Surround::Values> surround;
  std::vector<int> camera_of_view;
};

struct Mapping {
  double near = 0, far = 0;  // by which surroundings of either size darken
};

// Views of 300 elements in two states, with surroundings of their own, noise of 2 %, a factor of each photo, and one
// element in twenty that a view sees as something else. `mapping`: by camera.
Photos Draw(const std::vector<int>& camera_of_view, const std::vector<Mapping>& mapping, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  Photos photos;
  photos.camera_of_view = camera_of_view;
  for (int state = 0; state < 2; ++state) {
    std::vector<double> light(300);
    for (double& l : light) l = normal(rng);
    for (int view = 0; view < static_cast<int>(camera_of_view.size()); ++view) {
      const Mapping& of = mapping[static_cast<size_t>(camera_of_view[static_cast<size_t>(view)])];
      const double gain = 0.3 * normal(rng);
      for (int e = 0; e < 300; ++e) {
        const double near = light[static_cast<size_t>(e)] + 0.5 * normal(rng), far = 0.5 * normal(rng);
        double value =
            light[static_cast<size_t>(e)] + gain - of.near * near - of.far * far + 0.02 * normal(rng);
        if (normal(rng) > 1.65) value -= 0.7;
        photos.observations.push_back({e, view, state, 9, std::exp(value), 0, Eigen::Vector3d::Zero(), 0});
        photos.surround.push_back({static_cast<float>(near), static_cast<float>(far)});
      }
    }
  }
  return photos;
}

std::vector<std::optional<ToneMapping>> Find(const Photos& photos, int cameras = 1) {
  return FindToneMapping(photos.observations, photos.surround, photos.camera_of_view, cameras);
}

TEST(ToneMappingTest, StrengthIsFoundInEitherSize) {
  for (const Mapping mapping : {Mapping{0.1, 0}, Mapping{0, 0.1}}) {
    const auto found = Find(Draw({0, 0, 0, 0, 0}, {mapping}, 3))[0];
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->strength, 0.1, 3 * found->sigma);
    EXPECT_LT(found->sigma, 0.01);
    EXPECT_TRUE(found->IsFound());
    EXPECT_EQ(found->views, 5);
    EXPECT_LT(found->difference_without, 0.8 * found->difference);
  }
}

// Sixty draws: five sigmas and 2 % leave no chance to noise and things that only one view sees.
TEST(ToneMappingTest, PhotosThatTellLightAreLeftAlone) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto found = Find(Draw({0, 0, 0, 0, 0}, {Mapping{}}, seed))[0];
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->IsFound()) << seed;
    squares += std::pow(found->strength / found->sigma, 2) / 60;
  }
  EXPECT_LT(squares, 6) << "sigma is far too small";
}

// Glare and shine: bright amid bright surroundings.
TEST(ToneMappingTest, TheOtherSignIsNoToneMapping) {
  const auto found = Find(Draw({0, 0, 0, 0}, {Mapping{-0.1, 0}}, 5))[0];
  ASSERT_TRUE(found);
  EXPECT_LT(found->strength, 0);
  EXPECT_FALSE(found->IsFound());
}

TEST(ToneMappingTest, OneCameraOfTwo) {
  const auto found = Find(Draw({0, 1, 0, 1, 0, 1}, {Mapping{}, Mapping{0.2, 0}}, 6), 2);
  ASSERT_TRUE(found[0] && found[1]);
  EXPECT_FALSE(found[0]->IsFound());
  EXPECT_TRUE(found[1]->IsFound());
}

TEST(ToneMappingTest, TwoViewsAreNotJudged) { EXPECT_FALSE(Find(Draw({0, 0}, {Mapping{0.3, 0}}, 7))[0]); }

}  // namespace
}  // namespace luxfit
