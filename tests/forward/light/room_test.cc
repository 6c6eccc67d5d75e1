#include "forward/light/room.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A room with a screen across half of its width, a lamp behind it.
class ScreenedRoom : public testing::Test {
 protected:
  ScreenedRoom() {
    Scene scene = support::ClosedRoom({4, 4, 2});
    support::AddBox(scene, {Eigen::Vector3d(1.9, 0, 0), Eigen::Vector3d(2, 2, 2)}, support::Facing::kOutward,
                    {"screen"});
    room_ = std::make_unique<Room>(MakeRoom(scene, {{0.5, 0.25}, {16}}));
    lamp_.position = Eigen::Vector3d(1, 1, 1.5);
  }
  int FloorElementAt(double x, double y) const { return room_->patches.ElementAt(4, x / 4, y / 4); }

  std::unique_ptr<Room> room_;
  Luminaire lamp_;
};

TEST_F(ScreenedRoom, ReceiversAreElementsThenSensors) {
  const int e = FloorElementAt(3, 1);
  ASSERT_GE(e, 0);
  EXPECT_LT((room_->patches.elements[static_cast<size_t>(e)].center - Eigen::Vector3d(3, 1, 0)).norm(), 0.25);
  const Receivers receivers = MakeReceivers(*room_, {e}, {{{1, 3, 0.7}, {0, 0, 1}}});
  ASSERT_EQ(receivers.count(), 2);
  EXPECT_EQ(receivers.points[0].position, room_->patches.elements[static_cast<size_t>(e)].center);
  EXPECT_EQ(receivers.points[1].position, Eigen::Vector3d(1, 3, 0.7));
  EXPECT_NEAR(receivers.sensor_to_element.sum(), 1, 1e-5);  // closed room; float rounding
}

TEST_F(ScreenedRoom, TheScreenHidesTheLampFromWhatLiesBehindIt) {
  const std::vector<int> elements = {FloorElementAt(1, 1), FloorElementAt(3, 1), FloorElementAt(1, 3)};
  const Receivers receivers = MakeReceivers(
      *room_, elements, {{{3, 1, 0.01}, {0, 0, 1}}, {{1, 2, 0.01}, {0, 0, 1}}, {{1, 2, 0.01}, {0, 0, -1}}});
  const LuminaireVisibility visibility = ComputeVisibility(*room_, receivers, {lamp_});
  const std::vector<float> expected = {1, 0, 1, 0, 1, 0};  // the last faces away
  for (size_t r = 0; r < expected.size(); ++r) {
    EXPECT_EQ(visibility.receivers(static_cast<Eigen::Index>(r), 0), expected[r]) << r;
  }
  for (size_t i = 0; i < elements.size(); ++i) {
    EXPECT_EQ(visibility.elements(elements[i], 0), expected[i]) << i;
  }
}

TEST_F(ScreenedRoom, AShadowsEdgeCrossesElements) {
  // From (1, 1) past the screen's end at (1.9..2, 2): the edge meets y = 3 at x = 1 + 2 * 0.9 / 1 = 2.8.
  const LuminaireVisibility visibility = ComputeVisibility(*room_, MakeReceivers(*room_, {}, {}), {lamp_});
  EXPECT_EQ(visibility.elements(FloorElementAt(2.3, 3.1), 0), 1);
  EXPECT_EQ(visibility.elements(FloorElementAt(3.4, 3.1), 0), 0);
  bool partly = false;
  for (double x = 2.3; x < 3.4; x += 0.25) {
    const float share = visibility.elements(FloorElementAt(x, 3.1), 0);
    partly = partly || (share > 0 && share < 1);
  }
  EXPECT_TRUE(partly);
}

}  // namespace
}  // namespace luxfit
