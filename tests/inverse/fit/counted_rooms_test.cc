// Rooms drawn at random, all luminaires on, whose number nobody says. Each was counted or fitted wrongly. Found by
// study_random_rooms --estimate; the light tracer makes photos and readings (tests/support/inverse/random_room.h).
#include <gtest/gtest.h>

#include "tests/support/inverse/random_room.h"
#include "tests/support/inverse/unnamed_luminaires.h"

namespace luxfit {
namespace {

void ExpectCountedAndFound(std::uint64_t seed, const support::FoundLimits& limits) {
  const support::ObservedRandomRoom room = support::ObserveRandomRoomAllOn(seed);
  Findings findings;
  const RoomObservations counted = support::WithCounted(room.model, room.given, findings);
  std::printf("%s: %zu counted\n", room.drawn.words.c_str(), counted.luminaires.size());
  support::ExpectFound(room.drawn.room, room.model, counted, limits);
}

support::FoundLimits FoundByLight() {
  support::FoundLimits limits;
  limits.outlined_off_mm = limits.off_mm;
  limits.common_error_mm = 15;
  limits.reading_percent = 3;
  return limits;
}

// Three spots, of which photos show one. A beam narrower than the lobes that were tried left light beside it, and others were sought
// there. The fit does without a fourth.
TEST(CountedRooms, SpotsOfNarrowBeams) { ExpectCountedAndFound(9, FoundByLight()); }

// Two globes and two spots on one switch were one type, which shone all round: the spots lost their light.
TEST(CountedRooms, GlobesAndSpotsAreOfTwoKinds) { ExpectCountedAndFound(11, FoundByLight()); }

// Photos show a downlight 1 cm above the ceiling, where it lights nothing.
TEST(CountedRooms, DownlightsHangInTheRoom) { ExpectCountedAndFound(12, FoundByLight()); }

}  // namespace
}  // namespace luxfit
