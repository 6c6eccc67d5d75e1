// Turned spots in rooms drawn at random that ended wrong. Found by study_random_rooms; the light tracer makes photos and
// readings (tests/support/inverse/random_room.h).
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/inverse/random_room.h"

namespace luxfit {
namespace {

std::ptrdiff_t TurnedSpotsIn(const support::RandomRoom& drawn) {
  return std::count(drawn.kinds.begin(), drawn.kinds.end(), "turned spots");
}

// Five spots on one switch are points for the fit. One of 8 cm hangs 2 cm behind the plane of a cabinet's side and lights it
// with its rim. As a point it had to be in front, to 2 mm, and ended 17 mm off.
TEST(TurnedSpots, OneOverACabinetIsWithinItsIntervals) {
  const support::ObservedRandomRoom room = support::ObserveRandomRoom(15);
  ASSERT_EQ(TurnedSpotsIn(room.drawn), 5) << room.drawn.words;
  support::FoundLimits limits;
  limits.outlined_off_mm = limits.off_mm;  // one view sees one of the spots, none the others
  limits.reading_percent = 3;              // one place is 5.6 % off
  support::ExpectFound(room.drawn.room, room.model, room.given, limits);
}

// At the place that photos show, a lobe straight down explains nothing of the beam, and the right one leaves more than two
// thirds of the squares: with the former as the start, the spot lost its light, and globes beside it had six times theirs.
TEST(TurnedSpots, ANarrowBeamBesideGlobesStartsTurned) {
  const support::ObservedRandomRoom room = support::ObserveRandomRoom(22);
  ASSERT_EQ(TurnedSpotsIn(room.drawn), 1) << room.drawn.words;
  support::FoundLimits limits;
  limits.outlined_off_mm = limits.off_mm;  // globes of 27 cm are found as points, and known
  limits.common_error_mm = 15;             // to a centimetre
  limits.reading_percent = 3;              // the one that gives the scale is drawn 1.1 % too low
  support::ExpectFound(room.drawn.room, room.model, room.given, limits);
}

// Five washers on one switch: at their places, turned lobes leave little of the light but where things stand in the beams, and
// those few rows leave as much of the squares as lobes along the axes leave of all rows.
TEST(TurnedSpots, FiveWashersOnOneSwitchAreAllTurned) {
  const support::ObservedRandomRoom room = support::ObserveRandomRoom(14);
  ASSERT_EQ(std::count(room.drawn.kinds.begin(), room.drawn.kinds.end(), "washers"), 5) << room.drawn.words;
  support::FoundLimits limits;
  limits.outlined_off_mm = limits.off_mm;  // no outline tells where they are:
  limits.common_error_mm = 10;             // all that they share is known to 7 mm
  limits.reading_percent = 3;
  support::ExpectFound(room.drawn.room, room.model, room.given, limits);
}

}  // namespace
}  // namespace luxfit
