#include "apps/text/suggest.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

TEST(Suggest, DistanceCountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(EditDistance("lamp", "lamp"), 0);
  EXPECT_EQ(EditDistance("lamp", "Lamp"), 0);
  EXPECT_EQ(EditDistance("lamp", "lamps"), 1);
  EXPECT_EQ(EditDistance("lamp", "lmp"), 1);
  EXPECT_EQ(EditDistance("lamp", "ramp"), 1);
  EXPECT_EQ(EditDistance("lamp", "lapm"), 1);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("", "abc"), 3);
}

TEST(Suggest, NearestIsTheLeastDistanceAndNothingWhereNoneIsNear) {
  EXPECT_EQ(NearestName("expozure", {"file", "exposure", "exposures"}), "exposure");
  EXPECT_EQ(NearestName("cam1", {"cam0", "cam2"}), "cam0");
  EXPECT_EQ(NearestName("projector", {"cam0", "file"}), std::nullopt);
  EXPECT_EQ(NearestName("X", {"A", "B"}), std::nullopt);
  EXPECT_EQ(NearestName("a", {"A", "B"}), "A");
  EXPECT_EQ(NearestName("x", {}), std::nullopt);
}

TEST(Suggest, MessagesListTheKnownNames) {
  EXPECT_EQ(ListNames({"a"}), "a");
  EXPECT_EQ(ListNames({"a", "b", "c"}), "a, b or c");
  EXPECT_EQ(ListNames({"a", "b", "c"}, 2), "a, b, ...");
  EXPECT_EQ(ExpectedOneOf({"disc", "point"}, "dics"),
            "expected disc or point, got \"dics\"; did you mean \"disc\"?");
}

}  // namespace
}  // namespace luxfit
