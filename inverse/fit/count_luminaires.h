// Counts the luminaires that nobody names (inverse/choose/choose_count.h), from one state in which all are on.
//
// Returns the chosen number, at least 1, and records the choice; where nothing could be placed, `undetermined` is set and
// a warning says why. Throws as ChooseLuminaireCount does.
#ifndef LUXFIT_INVERSE_FIT_COUNT_LUMINAIRES_H_
#define LUXFIT_INVERSE_FIT_COUNT_LUMINAIRES_H_

#include "forward/light/room.h"
#include "inverse/fit/findings.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

// `given.luminaires`: those that are known already. `max_count`: the most that are tried.
int CountLuminaires(const Room& room, const RoomObservations& given, int max_count, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_COUNT_LUMINAIRES_H_
