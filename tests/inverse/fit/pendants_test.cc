// Pendants that shine up and down, in rooms drawn at random: no lobe to one side explains their light at its place.
//
// Found by study_random_rooms. Four of them on one switch (seed 3) ended with fluxes 16 to 27 % too high: the indirect light of a
// poor first fit was held while models were chosen, and rows that disagreed with it never came back. One beside six downlights
// (seed 16) became a point that shines to all sides at another height, 0.4 m off, and downlights ended 0.8 m off. The light
// tracer makes photos and readings (tests/support/inverse/random_room.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "forward/light/room.h"
#include "tests/support/inverse/random_room.h"

namespace luxfit {
namespace {

class Pendants : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Pendants, AreFoundWhereTheyHangWithTheLightOfBothSides) {
  std::mt19937_64 rng(GetParam());
  const support::RandomRoom drawn = support::DrawRoom(rng);
  ASSERT_GT(std::count(drawn.kinds.begin(), drawn.kinds.end(), "pendants"), 0) << drawn.words;
  RoomOptions options;
  options.patches.patch_size_m = 0.4;
  options.patches.element_size_m = 0.2;
  const Room model = MakeRoom(drawn.mesh, options);
  support::TracedRoomOptions traced;
  traced.paths_per_point = 128;
  const RoomObservations given = support::ObserveTraced(drawn.room, model, rng, traced);
  support::FoundLimits limits;
  limits.outlined_off_mm = 20;  // one view sees one of the downlights
  limits.off_mm = 30;
  limits.common_error_mm = 10;
  support::ExpectFound(drawn.room, model, given, limits);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Pendants, testing::Values(3, 16));

}  // namespace
}  // namespace luxfit
