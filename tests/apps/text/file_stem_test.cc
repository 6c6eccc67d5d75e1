#include "apps/text/file_stem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace luxfit {
namespace {

TEST(FileStem, KeepsWhatAnyFileSystemTakes) {
  EXPECT_EQ(FileStem("L1-a.b_c"), "L1-a.b_c");
  EXPECT_EQ(FileStem("../up down"), ".._up_down");
  EXPECT_EQ(FileStem("a:b*c?\n"), "a_b_c__");
}

TEST(FileStem, NoTwoAreAlike) {
  EXPECT_THAT(DistinctFileStems({"A 1", "A/1", "A_1", "a_1", "B"}),
              testing::ElementsAre("A_1", "A_1_2", "A_1_3", "a_1_4", "B"));
  EXPECT_THAT(DistinctFileStems({"A", "A_2", "a"}), testing::ElementsAre("A", "A_2", "a_3"));
}

}  // namespace
}  // namespace luxfit
