#include "inverse/model/internal/search/watched_places.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

constexpr Distribution kCosine = Distribution::kCosinePower;

// Four cameras about the middle of a room of 4 m x 4 m x 3 m, 1.5 m high.
std::vector<Watcher> Watchers() {
  return {{{1, 1, 1.5}, {}, {0}}, {{3, 1, 1.5}, {}, {0}}, {{1, 3, 1.5}, {}, {0}}, {{3, 3, 1.5}, {}, {1}}};
}

class WatchedRoom : public testing::Test {
 protected:
  bool Refutes(const Eigen::Vector3d& place, const Lobe& lobe, const std::vector<bool>& counts) const {
    return IsRefuted(lobe, ViewsOf(room_, Watchers(), place), counts);
  }

  Room room_ = MakeRoom(support::ClosedRoom({4, 4, 3}), {{1, 1}, {16}});
  const std::vector<bool> all_{true, true, true, true};
  const Eigen::Vector3d under_ceiling_{2, 2, 2.9};
};

TEST_F(WatchedRoom, ALuminaireThatShinesTowardsThreeViewsWouldBeSeen) {
  EXPECT_TRUE(Refutes(under_ceiling_, {Distribution::kIsotropic}, all_));
  EXPECT_TRUE(Refutes(under_ceiling_, {kCosine, 1, {0, 0, -1}}, all_));
  EXPECT_TRUE(Refutes(under_ceiling_, {kCosine, 1, {0, 0, -1}, 0.5}, all_));
}

TEST_F(WatchedRoom, OneThatShinesElsewhereWouldNot) {
  EXPECT_FALSE(Refutes(under_ceiling_, {kCosine, 1, {0, 0, -1}, 0.8}, all_));  // four times as bright above
  EXPECT_FALSE(Refutes(under_ceiling_, {kCosine, 1, {0, 0, 1}}, all_));
  EXPECT_FALSE(Refutes(under_ceiling_, {kCosine, 32, {0, 0, -1}}, all_));  // a narrow beam between them
  EXPECT_FALSE(Refutes({0.01, 2, 1.5}, {kCosine, 1, {-1, 0, 0}}, all_));   // towards the wall
}

TEST_F(WatchedRoom, TwoViewsAreTooFew) {
  const std::vector<bool> in_state_0{true, true, false, false};
  EXPECT_FALSE(Refutes(under_ceiling_, {Distribution::kIsotropic}, in_state_0));
}

TEST_F(WatchedRoom, ViewsThatSurfacesHideAndPicturesThatEndDoNotWatch) {
  EXPECT_TRUE(ViewsOf(room_, Watchers(), {2, 2, 3.5}).empty());  // above the ceiling
  std::vector<Watcher> looking_down = Watchers();
  for (Watcher& w : looking_down) w.border = {{1, 1, -1}, {1, -1, -1}, {-1, -1, -1}, {-1, 1, -1}};
  EXPECT_TRUE(ViewsOf(room_, looking_down, under_ceiling_).empty());
  EXPECT_EQ(ViewsOf(room_, looking_down, {2, 2, 0.1}).size(), 4u);
}

TEST(WatchingViews, AreNoneWherePhotosShowNoLuminaireBeyondDoubt) {
  SeenPlace place;
  place.views = 2;
  EXPECT_TRUE(WatchingViews({place}, Watchers()).empty());
  place.views = 3;
  EXPECT_EQ(WatchingViews({place}, Watchers()).size(), 4u);
}

}  // namespace
}  // namespace luxfit
