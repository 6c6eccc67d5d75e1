#include "apps/stages/warning_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace luxfit {
namespace {

TEST(PutCausesFirst, KeepsTheOrderOfStagesWithinBothKinds) {
  std::vector<Warning> warnings;
  for (const char* code : {"pose_ambiguous", "tag_disagrees", "model_misfit", "reading_outside",
                           "readings_as_if", "readings_contradict"})
    warnings.push_back({code, "", ""});
  PutCausesFirst(warnings);
  std::vector<std::string> order;
  for (const Warning& w : warnings) order.push_back(w.code);
  EXPECT_THAT(order, testing::ElementsAre("tag_disagrees", "readings_as_if", "pose_ambiguous", "model_misfit",
                                          "reading_outside", "readings_contradict"));
}

}  // namespace
}  // namespace luxfit
