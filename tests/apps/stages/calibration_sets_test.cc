#include "apps/stages/calibrate/calibration_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace luxfit {
namespace {

using testing::ElementsAre;

TEST(CalibrationSets, ImagesOfOneNumberAreOneSet) {
  const ImageSets sets = PairImages(
      {{"left01.jpg", "left02.jpg", "left04.jpg"}, {"right1.jpg", "right02.jpg", "right04.jpg"}}, "auto");
  EXPECT_TRUE(sets.is_rig);
  EXPECT_EQ(sets.sets[0], sets.sets[1]);
  const ImageSets folders =
      PairImages({{"cam0/0007.png", "cam0/0009.png"}, {"cam1/0009.png", "cam1/0011.png"}}, "numbers");
  EXPECT_TRUE(folders.is_rig);
  EXPECT_EQ(folders.sets[0][1], folders.sets[1][0]);
  EXPECT_NE(folders.sets[0][0], folders.sets[1][1]);
}

TEST(CalibrationSets, EqualNamesCountBeforeNumbers) {
  const std::vector<std::vector<std::string>> named = {{"l/a.png", "l/b.png", "l/c.png"},
                                                       {"r/b.png", "r/c.png", "r/a.png"}};
  const ImageSets sets = PairImages(named, "auto");
  EXPECT_EQ(sets.rule, "names");
  EXPECT_THAT(sets.sets[1], ElementsAre(sets.sets[0][1], sets.sets[0][2], sets.sets[0][0]));
  EXPECT_EQ(
      PairImages({{"l/1_7.png", "l/2_7.png", "l/3_7.png"}, {"r/1_7.png", "r/2_7.png", "r/3_7.png"}}, "auto")
          .rule,
      "names")
      << "numbers that do not tell a camera's images apart";
  EXPECT_EQ(PairImages({{"a1.jpg", "a2.jpg", "a3.jpg"}, {"b1.jpg", "b2.jpg", "b3.jpg"}}, "auto").rule,
            "numbers");
  EXPECT_EQ(PairImages(named, "order").rule, "order");
  EXPECT_EQ(PairImages(named, "none").rule, "none");
  EXPECT_EQ(PairImages({{"l/a.png"}, {"r/b.png"}}, "names").rule, "none");
}

TEST(CalibrationSets, WithoutPairsEachImageStandsAlone) {
  const std::vector<std::vector<std::string>> named = {{"a.jpg", "b.jpg"}, {"c.jpg", "d.jpg"}};
  EXPECT_FALSE(PairImages(named, "auto").is_rig);
  EXPECT_THAT(PairImages(named, "order").sets[1], ElementsAre(0, 1));
  const std::vector<std::vector<std::string>> numbered = {{"a1.jpg", "a2.jpg", "a3.jpg"},
                                                          {"b1.jpg", "b2.jpg", "b3.jpg"}};
  EXPECT_TRUE(PairImages(numbered, "auto").is_rig);
  EXPECT_FALSE(PairImages(numbered, "none").is_rig);
  EXPECT_FALSE(
      PairImages({{"x1/a.png", "x1/b1.png", "y1.png"}, {"b1.png", "y1.png", "z1.png"}}, "auto").is_rig)
      << "numbers that do not tell a camera's images apart";
  EXPECT_FALSE(PairImages({{"a1.jpg", "a2.jpg"}}, "auto").is_rig) << "one camera";
}

}  // namespace
}  // namespace luxfit
