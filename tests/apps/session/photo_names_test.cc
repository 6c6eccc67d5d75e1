#include "apps/session/photos/photo_names.h"

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

TEST(PhotoNamesTest, FoldersOfViews) {
  for (const char* all : {"all", "B"}) {
    const PhotoNames names =
        GuessViewsAndStates({"v00/A.png", std::string("v00/") + all + ".png", "v01/A.png"});
    EXPECT_EQ(names.photos[0].view, "v00");
    EXPECT_EQ(names.photos[1].state, all);
  }
  const PhotoNames brackets = GuessViewsAndStates({"1/A_1.jpg", "1/A_2.jpg", "2/A_1.jpg", "2/B_1.jpg"});
  EXPECT_EQ(brackets.photos[1].view, "1");
  EXPECT_EQ(brackets.photos[1].state, "A");
  // The same camera numbers under two numbered folders say nothing of states.
  EXPECT_FALSE(GuessViewsAndStates({"1/IMG_1234.jpg", "2/IMG_1234.jpg"}).do_names_tell);
  EXPECT_EQ(GuessViewsAndStates({"v1/IMG_1.jpg", "v2/IMG_1.jpg"}).photos[0].state, "v1");
}

TEST(PhotoNamesTest, NumbersOfExposures) {
  const PhotoNames names =
      GuessViewsAndStates({"v00_A_1.jpg", "v00_A_2.jpg", "v00_all.jpg", "v01_A_1.jpg", "v01_all_1.jpg"});
  EXPECT_TRUE(names.do_names_tell);
  EXPECT_EQ(names.photos[1].view, "v00");
  EXPECT_EQ(names.photos[1].state, "A");
  EXPECT_EQ(names.photos[2].state, "all");
}

TEST(PhotoNamesTest, NamesOfPhonesTellNothing) {
  for (const std::vector<std::string>& files : std::vector<std::vector<std::string>>{
           {"PXL_20240501_100000123.jpg", "PXL_20240501_100010456.MP.jpg", "PXL_20240501_100020789.MP.jpg"},
           {"20240101_123456.jpg", "20240101_123501.jpg"},
           {"20240501_HDR_1.jpg", "20240501_HDR_2.jpg"},
           {"IMG_1234.HEIC", "IMG_1235.JPG", "DSC_0001.JPG"}})
    EXPECT_FALSE(GuessViewsAndStates(files).do_names_tell) << files[0];
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
