// Pendants that shine up and down, in rooms drawn at random: no lobe to one side explains their light at its place.
//
// Found by study_random_rooms. Four of them on one switch (seed 3) ended with fluxes 16 to 27 % too high: the indirect light of a
// poor first fit was held while models were chosen, and rows that disagreed with it never came back. One beside six downlights
// (seed 16) became a point that shines to all sides at another height, 0.4 m off, and downlights ended 0.8 m off. The light
// tracer makes photos and readings (tests/support/inverse/random_room.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "tests/support/inverse/random_room.h"

namespace luxfit {
namespace {

class Pendants : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Pendants, AreFoundWhereTheyHangWithTheLightOfBothSides) {
  const support::ObservedRandomRoom room = support::ObserveRandomRoom(GetParam());
  ASSERT_GT(std::count(room.drawn.kinds.begin(), room.drawn.kinds.end(), "pendants"), 0) << room.drawn.words;
  support::FoundLimits limits;
  limits.outlined_off_mm = 20;  // one view sees one of the downlights
  limits.off_mm = 30;
  limits.common_error_mm = 10;
  support::ExpectFound(room.drawn.room, room.model, room.given, limits);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Pendants, testing::Values(3, 16));

}  // namespace
}  // namespace luxfit
