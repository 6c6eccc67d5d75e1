#include "inverse/fit/internal/judge/unmodelled.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// A room of 4 m x 3.2 m in elements of 0.1 m. Views 0 and 1 see something else before the floor from (1, 1) to (1.8, 1.5),
// view 0 alone beside it, and both at one element of a wall.
class UnmodelledTest : public testing::Test {
 protected:
  UnmodelledTest()
      : room_(
            MakeRoom(support::ClosedRoom({4, 3.2, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"}),
                     {{0.4, 0.1}, {}})) {
    labels_.is_estimated = true;
    labels_.common_sigma = 0.01;
    bool is_wall_marked = false;
    for (size_t e = 0; e < room_.patches.elements.size(); ++e) {
      const Eigen::Vector3d& at = room_.patches.elements[e].center;
      const bool is_floor = at.z() < 0.01;
      const bool is_chair = is_floor && at.x() > 1 && at.x() < 1.8 && at.y() > 1 && at.y() < 1.5;
      const bool is_beside = is_floor && at.x() > 2 && at.x() < 2.5 && at.y() > 1 && at.y() < 1.5;
      const bool is_wall = !is_wall_marked && at.x() < 0.01;
      is_wall_marked = is_wall_marked || is_wall;
      for (int view = 0; view < 3; ++view) {
        const bool is_other = ((is_chair || is_wall) && view < 2) || (is_beside && view == 0);
        labels_.views.push_back({static_cast<int>(e), view, is_other ? 0.1 : 0.95});
      }
    }
  }
  const Room room_;
  SurfaceLabels labels_;
};

TEST_F(UnmodelledTest, APlaceIsWhereSeveralViewsSeeSomethingElse) {
  const std::vector<UnmodelledPlace> places = FindUnmodelled(room_, labels_);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_NEAR(places[0].area_m2, 0.4, 1e-9);  // sums of doubles
  EXPECT_NEAR((places[0].center - Eigen::Vector3d(1.4, 1.25, 0)).norm(), 0, 1e-9);
  EXPECT_EQ(places[0].views, 2);
  EXPECT_EQ(room_.scene.materials[static_cast<size_t>(places[0].material)], "floor");
}

TEST_F(UnmodelledTest, TheWarningNamesIt) {
  Findings findings;
  RecordLabels(room_, labels_, findings);
  ASSERT_EQ(findings.warnings.size(), 1u);
  EXPECT_EQ(findings.warnings[0].code, "unmodelled_surface");
  EXPECT_NE(findings.warnings[0].message.find("0.4 m2 of \"floor\" near (1.40, 1.25, 0.00) m in 2 views"),
            std::string::npos)
      << findings.warnings[0].message;
  ASSERT_EQ(findings.choices.size(), 1u);
  EXPECT_FALSE(findings.IsUndetermined());
}

// A desk's box in the room: views see something else on a share of what they show of its faces.
std::vector<UnmodelledPlace> PlacesOnDesk(double share) {
  Scene scene = support::ClosedRoom({4, 3.2, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  support::AddBox(scene, {Eigen::Vector3d(1, 1, 0.7), Eigen::Vector3d(2.6, 1.8, 0.75)},
                  support::Facing::kOutward, {"desk"});
  const Room room = MakeRoom(scene, {{0.4, 0.1}, {}});
  SurfaceLabels labels;
  labels.is_estimated = true;
  for (size_t e = 0; e < room.patches.elements.size(); ++e) {
    const Eigen::Vector3d& at = room.patches.elements[e].center;
    const bool is_desk =
        room.scene.materials[static_cast<size_t>(room.patches.PatchOf(static_cast<int>(e)).material)] ==
        "desk";
    const bool is_other = is_desk && at.x() < 1 + share * 1.6;
    for (int view = 0; view < 2; ++view)
      labels.views.push_back({static_cast<int>(e), view, is_other ? 0.1 : 0.95});
  }
  return FindUnmodelled(room, labels);
}

TEST_F(UnmodelledTest, ViewsLookThroughAPieceThatTheRoomLacks) {
  for (const double share : {0.3, 0.9}) {
    const std::vector<UnmodelledPlace> places = PlacesOnDesk(share);
    ASSERT_FALSE(places.empty()) << share;
    EXPECT_EQ(places[0].is_of_lacking_piece, share > 0.5) << share;
  }
  for (const UnmodelledPlace& place : FindUnmodelled(room_, labels_)) EXPECT_FALSE(place.is_of_lacking_piece);
}

TEST_F(UnmodelledTest, NothingIsSaidWhereNothingWasEstimated) {
  labels_.is_estimated = false;
  Findings findings;
  RecordLabels(room_, labels_, findings);
  EXPECT_TRUE(findings.warnings.empty() && findings.choices.empty());
}

}  // namespace
}  // namespace luxfit
