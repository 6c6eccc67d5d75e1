#include "inverse/choose/internal/detail/enough_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <set>
#include <vector>

#include "tests/support/inverse/direct_photos.h"
#include "tests/support/scenes.h"
#include "tests/support/test_rng.h"

namespace luxfit {
namespace {

constexpr double kRho = 0.5;
constexpr int kFirst = 150;  // elements of the first level
const Eigen::Vector3d kLamp(0.8, 1.1, 1.2);

std::vector<Observation> ElementsInARow(int count) {
  std::vector<Observation> observations(static_cast<size_t>(count));
  for (int e = 0; e < count; ++e) observations[static_cast<size_t>(e)].element = 2 * e;
  return observations;
}

TEST(EvenLevels, TheFirstIsAsThinElementsTakes) {
  const std::vector<Observation> all = ElementsInARow(1000);
  for (const int first : {1, 90, 150, 300, 1000, 5000}) {
    const std::vector<int> level = LevelsOf(all, first);
    std::set<int> taken, thin;
    for (size_t i = 0; i < all.size(); ++i) {
      if (level[i] == 0) taken.insert(all[i].element);
    }
    for (const Observation& o : ThinElements(all, first)) thin.insert(o.element);
    EXPECT_EQ(taken, thin) << first;
  }
}

// Every sixteenth, every eighth, ... all.
TEST(EvenLevels, EachDoublesTheElements) {
  const std::vector<int> level = LevelsOf(ElementsInARow(1600), 100);
  for (int k = 0; k <= 4; ++k) {
    std::ptrdiff_t up_to = 0;
    for (const int l : level) up_to += l <= k ? 1 : 0;
    EXPECT_EQ(up_to, 100 << k);
  }
}

// An isotropic point of 1 lm in a cube of 2 m without reflections: photos are closed forms.
class RowsOfPointInCube : public testing::Test {
 protected:
  RowsOfPointInCube() {
    data_.dimming = {Eigen::VectorXd::Ones(1)};
    data_.indirect_is_held = true;
    data_.observations = support::DirectPhotos(room_, kLamp, kRho);
    state_.luminaires.resize(1);
    state_.luminaires[0].distribution = Distribution::kIsotropic;
    state_.luminaires[0].position = kLamp;
    state_.free.resize(1);
    state_.free[0].flux = false;
    state_.albedo = Eigen::VectorXd::Constant(1, kRho);
    state_.albedo_free = {true};
    state_.camera_scale_free = false;
    options_.start_is_near = true;
    options_.photo_design_effect = 1;
    options_.has_texture = false;
  }

  // Multiplies by errors of single elements, and by errors that the elements of a facet's quarter share.
  void Err(double own, double shared) {
    std::normal_distribution<double> normal;
    std::vector<double> of_quarter(24);
    for (double& error : of_quarter) error = shared * normal(rng_);
    for (Observation& o : data_.observations) {
      const Patch& patch = room_.patches.PatchOf(o.element);
      const Eigen::Vector2d at = room_.scene.facets[static_cast<size_t>(patch.facet)].CoordinatesOf(
          room_.patches.elements[static_cast<size_t>(o.element)].center);
      const int quarter = 4 * patch.facet + (at.x() > 0.5 ? 1 : 0) + (at.y() > 0.5 ? 2 : 0);
      o.relative_luminance *= 1 + own * normal(rng_) + of_quarter[static_cast<size_t>(quarter)];
    }
  }

  EnoughRows Fit() const { return FitToEnoughRows(room_, data_, state_, {}, kFirst, options_); }

  std::mt19937_64 rng_ = support::TestRng();
  Room room_ = MakeRoom(support::ClosedRoom({2, 2, 2}), {{0.4, 0.1}, {16}});  // 2400 elements
  LightData data_;
  LightState state_;
  FitLuminairesOptions options_;
};

// Each doubling of independent rows moves the answer by about a sigma of it.
TEST_F(RowsOfPointInCube, IndependentErrorsAskForAllElements) {
  Err(0.02, 0);
  const EnoughRows enough = Fit();
  ASSERT_FALSE(enough.taken.doublings.empty());
  for (const RowDoubling& d : enough.taken.doublings)
    std::printf("%d elements: twice as many move %.3f sigma\n", d.elements, d.effect.sigmas);
  EXPECT_GE(enough.taken.doublings.front().effect.sigmas, kWorthSigmas);
  EXPECT_EQ(enough.taken.elements, 2400);
  EXPECT_EQ(enough.observations.size(), 2400u);
  EXPECT_EQ(enough.fit.predicted.size(), 2400);
}

// Errors of 3 % that a quarter of a facet shares do not go away with more of its elements.
TEST_F(RowsOfPointInCube, SharedErrorsAskForFew) {
  Err(0.0005, 0.03);
  const EnoughRows enough = Fit();
  ASSERT_FALSE(enough.taken.doublings.empty());
  for (const RowDoubling& d : enough.taken.doublings)
    std::printf("%d elements: twice as many move %.3f sigma\n", d.elements, d.effect.sigmas);
  EXPECT_LT(enough.taken.doublings.back().effect.sigmas, kWorthSigmas);
  EXPECT_LT(enough.taken.elements, 2400);
  EXPECT_EQ(enough.taken.observed_elements, 2400);
  EXPECT_EQ(enough.fit.predicted.size(), static_cast<Eigen::Index>(enough.observations.size()));
  // What the answer lacks of a fit to all is what was predicted to be little.
  const LuminaireFit all = FitLuminaires(room_, data_, enough.fit.state, {}, options_);
  const Eigen::VectorXd moved = PackParameters(all.state, enough.fit.parameters) -
                                PackParameters(enough.fit.state, enough.fit.parameters);
  // Doublings that follow move less each, by the root of two: their sum is at most 1 / (1 - sqrt(1 / 2)) of the first.
  EXPECT_LT(LargestShiftOf(enough.fit, moved).sigmas, kWorthSigmas / (1 - std::sqrt(0.5)));
}

TEST_F(RowsOfPointInCube, FewElementsAreFittedAtOnce) {
  Err(0.02, 0);
  const EnoughRows enough = FitToEnoughRows(room_, data_, state_, {}, 2400 / kFewTimes, options_);
  EXPECT_TRUE(enough.taken.doublings.empty());
  const LuminaireFit all = FitLuminaires(room_, data_, state_, {}, options_);
  EXPECT_EQ(PackParameters(enough.fit.state, enough.fit.parameters),
            PackParameters(all.state, all.parameters));
}

}  // namespace
}  // namespace luxfit
