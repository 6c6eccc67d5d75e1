#include "inverse/model/internal/search/spread_elements.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A room of 6 m x 5 m x 3 m in elements of 0.1 m. All of them reflect half of an even indirect light of 1.
class SpreadElementsTest : public testing::Test {
 protected:
  SpreadElementsTest() : room_(MakeRoom(support::ClosedRoom({6, 5, 3}), {{0.5, 0.1}, {}})) {
    for (size_t e = 0; e < room_.patches.elements.size(); ++e) {
      Observation o;
      o.element = static_cast<int>(e);
      o.relative_luminance = 0.5;
      o.relative_indirect = 1;
      data_.observations.push_back(o);
    }
  }

  bool IsInPool(const Observation& o, double radius_m) const {
    const Element& element = room_.patches.elements[static_cast<size_t>(o.element)];
    return (element.center - Eigen::Vector3d(4, 3, 0)).norm() < radius_m;
  }
  // Lights the floor about (4, 3) ten times as brightly as the rest.
  void LightPool(double radius_m) {
    for (Observation& o : data_.observations)
      if (IsInPool(o, radius_m)) o.relative_luminance = 5;
  }

  struct Counts {
    size_t all = 0, in_pool = 0;
  };
  Counts Spread(double radius_m) const {
    std::set<int> all, in_pool;
    for (const Observation& o : SpreadElements(room_, data_, 600)) {
      all.insert(o.element);
      if (IsInPool(o, radius_m)) in_pool.insert(o.element);
    }
    return {all.size(), in_pool.size()};
  }

  const Room room_;
  LightData data_;
};

TEST_F(SpreadElementsTest, ABeamsPoolGetsEnough) {
  constexpr double kRadius = 0.6;  // 113 of 12 600 elements
  LightPool(kRadius);
  const Counts counts = Spread(kRadius);
  EXPECT_EQ(counts.in_pool, 60u);
  EXPECT_NEAR(static_cast<double>(counts.all), 655, 40);
}

TEST_F(SpreadElementsTest, APoolOfFewElementsGetsThemAll) {
  constexpr double kRadius = 0.25;
  LightPool(kRadius);
  size_t pool = 0;
  for (const Observation& o : data_.observations) pool += IsInPool(o, kRadius) ? 1 : 0;
  EXPECT_LT(pool, 60u);
  EXPECT_EQ(Spread(kRadius).in_pool, pool);
}

TEST_F(SpreadElementsTest, EvenLightGetsNoMore) {
  EXPECT_EQ(SpreadElements(room_, data_, 600).size(), ThinElements(data_.observations, 600).size());
}

}  // namespace
}  // namespace luxfit
