#include "inverse/model/internal/superposed_light.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace luxfit {
namespace {

// Two luminaires, each alone, together, and the first dimmed beside the second. An element's own light of each is 3 and 5.
class SuperposedStates : public testing::Test {
 protected:
  SuperposedStates() {
    data_.dimming = {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1),
                     Eigen::Vector2d(0.5, 1)};
  }

  void Show(int element, int state, double relative_luminance) {
    Observation o;
    o.element = element;
    o.state = state;
    o.relative_luminance = relative_luminance;
    data_.observations.push_back(o);
  }

  double Of(int element, int state) const {
    for (const SuperposedLight& light : SuperposeStates(data_))
      if (light.element == element && light.state == state) return light.relative_luminance;
    return 0;
  }

  LightData data_;
};

TEST_F(SuperposedStates, WhatOneStateLacksIsTheDifferenceOfOthers) {
  Show(7, 1, 5);
  Show(7, 2, 8);
  EXPECT_NEAR(Of(7, 0), 3, 1e-12);
  EXPECT_NEAR(Of(7, 3), 6.5, 1e-12);
  EXPECT_EQ(SuperposeStates(data_).size(), 2u);
}

TEST_F(SuperposedStates, ViewsAreAveraged) {
  Show(7, 1, 4);
  Show(7, 1, 6);
  Show(7, 2, 8);
  EXPECT_NEAR(Of(7, 0), 3, 1e-12);
}

TEST_F(SuperposedStates, OneStateTellsNothingOfAnother) {
  Show(7, 2, 8);
  EXPECT_TRUE(SuperposeStates(data_).empty());
}

TEST_F(SuperposedStates, LightIsNotNegative) {
  Show(7, 1, 5);
  Show(7, 2, 4);
  EXPECT_EQ(Of(7, 0), 0);
}

// The small difference of two bright states is their noise.
TEST_F(SuperposedStates, NoiseIsNotMultiplied) {
  Show(7, 1, 7);
  Show(7, 2, 8);
  EXPECT_EQ(Of(7, 0), 0);
}

TEST_F(SuperposedStates, WhatIsShownIsNotComputed) {
  for (int state = 0; state < 4; ++state) Show(7, state, 1);
  EXPECT_TRUE(SuperposeStates(data_).empty());
}

}  // namespace
}  // namespace luxfit
