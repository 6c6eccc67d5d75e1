#include "inverse/choose/internal/two_sides.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace luxfit {
namespace {

// An empty room of 4 m x 3 m x 2.8 m, all elements observed.
class TwoSides : public testing::Test {
 protected:
  TwoSides() : room_(MakeRoom(support::ClosedRoom({4, 3, 2.8}), {{0.4, 0.1}, {}})) {
    for (size_t e = 0; e < room_.patches.elements.size(); ++e) {
      problem_.data.observations.emplace_back();
      problem_.data.observations.back().element = static_cast<int>(e);
    }
  }
  bool SeesFrom(double height_m) const {
    Luminaire luminaire;
    luminaire.position = {2, 1.5, height_m};
    return SeesBothSides(room_, problem_, luminaire);
  }
  const Room room_;
  SubProblem problem_;
};

TEST_F(TwoSides, APendantIsSeenFromBoth) { EXPECT_TRUE(SeesFrom(2.5)); }

TEST_F(TwoSides, NothingSeesWhatShinesIntoTheCeiling) {
  EXPECT_FALSE(SeesFrom(2.795));
  EXPECT_FALSE(SeesFrom(2.72));
}

TEST_F(TwoSides, ACeilingThatNoPhotoShowsTellsNothing) {
  auto& seen = problem_.data.observations;
  seen.erase(std::remove_if(seen.begin(), seen.end(),
                            [&](const Observation& o) {
                              return room_.patches.elements[static_cast<size_t>(o.element)].center.z() > 2.3;
                            }),
             seen.end());
  EXPECT_FALSE(SeesFrom(2.3));
}

}  // namespace
}  // namespace luxfit
