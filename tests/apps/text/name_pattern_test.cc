#include "apps/text/name_pattern.h"

#include <gtest/gtest.h>

namespace luxfit {
namespace {

TEST(NamePattern, AStarIsAnyText) {
  EXPECT_TRUE(MatchesPattern("F12", "F*"));
  EXPECT_TRUE(MatchesPattern("F12", "*"));
  EXPECT_TRUE(MatchesPattern("F12", "*1*2*"));
  EXPECT_TRUE(MatchesPattern("", "*"));
  EXPECT_FALSE(MatchesPattern("F12", "F1"));
  EXPECT_FALSE(MatchesPattern("F12", "*1"));
  EXPECT_FALSE(MatchesPattern("F12", ""));
}

}  // namespace
}  // namespace luxfit
