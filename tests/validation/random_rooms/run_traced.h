// Fits what photos and readings of a traced room tell, by the steps of `luxfit run` that begin at observations.
//
//   observations -> explained and corrected (inverse/observe/as_if/internal/explained_observations.h)
//                -> FitRoom -> states that photos contradict -> readings checked and explained
//
// The camera has no vignetting and a straight response, both known. No pictures exist: furniture is not looked for.
#ifndef LUXFIT_TESTS_VALIDATION_RANDOM_ROOMS_RUN_TRACED_H_
#define LUXFIT_TESTS_VALIDATION_RANDOM_ROOMS_RUN_TRACED_H_

#include <cstddef>
#include <string>

#include "forward/light/room.h"
#include "inverse/fit/fit_room.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

// The names that warnings use.
std::string StateName(size_t state);
std::string PhotoName(int view, int state);
std::string PlaceName(size_t reading);

// Returns the fit with the warnings of all steps, in their order. `applies`: an explanation of the states or the readings that
// stands alone is taken as right, as `luxfit run --apply` does (apps/stages/check/applied_explanations.h).
RoomFit RunTraced(const Room& model, RoomObservations given, bool applies);

}  // namespace luxfit

#endif  // LUXFIT_TESTS_VALIDATION_RANDOM_ROOMS_RUN_TRACED_H_
