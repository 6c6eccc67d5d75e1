#include "apps/session/photo_names.h"

#include <gmock/gmock.h>

namespace luxfit {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(PhotoNamesTest, ViewThenState) {
  const PhotoNames names = GuessViewsAndStates({"v00_A.png", "v00_all.png", "v01_A.png", "v01_all.png"});
  EXPECT_EQ(names.photos[1].view, "v00");
  EXPECT_EQ(names.photos[1].state, "all");
}

TEST(PhotoNamesTest, StateThenView) {
  const PhotoNames names = GuessViewsAndStates({"all-v0.png", "all-v1.png", "off-v0.png", "off-v1.png"});
  EXPECT_EQ(names.photos[0].view, "v0");
  EXPECT_EQ(names.photos[0].state, "all");
}

TEST(PhotoNamesTest, FoldersOfStates) {
  const PhotoNames names = GuessViewsAndStates({"A/IMG_1.dng", "A/IMG_2.dng", "B/IMG_1.dng", "B/IMG_2.dng"});
  EXPECT_EQ(names.photos[2].view, "IMG_1");
  EXPECT_EQ(names.photos[2].state, "B");
}

TEST(PhotoNamesTest, CameraNumbersAreNoStates) {
  const PhotoNames names = GuessViewsAndStates({"DSC_0001.jpg", "IMG_17.jpg", "x.jpg"});
  EXPECT_EQ(names.photos[0].view, "DSC_0001");
  EXPECT_EQ(names.photos[0].state, "all");
}

// A camera's running numbers share what stands before them, like states of one view would.
TEST(PhotoNamesTest, RunningNumbersAreViews) {
  const PhotoNames names = GuessViewsAndStates({"IMG_0001.jpg", "IMG_0002.jpg", "IMG_0003.jpg"});
  EXPECT_EQ(names.photos[2].view, "IMG_0003");
  EXPECT_EQ(names.photos[2].state, "all");
}

TEST(PhotoNamesTest, StatesByTheirNames) {
  const PhotoNames names =
      GuessViewsAndStates({"v0_A.png", "v0_B.png", "v0_all.png", "v0_off.png", "v1_A.png"});
  const std::vector<GuessedState> states = GuessStates(names);
  ASSERT_EQ(states.size(), 4U);
  EXPECT_THAT(states[0].luminaires, ElementsAre("A"));
  EXPECT_EQ(states[2].id, "all");
  EXPECT_THAT(states[2].luminaires, ElementsAre("A", "B"));
  EXPECT_THAT(states[3].luminaires, IsEmpty());
}

TEST(PhotoNamesTest, OccasionsAreNoLuminaires) {
  const PhotoNames names = GuessViewsAndStates({"v0_A.png", "v0_lamp2.png", "v0_evening.png", "v1_A.png"});
  const std::vector<GuessedState> states = GuessStates(names);
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[1].id, "evening");
  EXPECT_THAT(states[1].luminaires, ElementsAre("A", "lamp2"));
  EXPECT_THAT(states[2].luminaires, ElementsAre("lamp2"));
}

}  // namespace
}  // namespace luxfit
