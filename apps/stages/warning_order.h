// Puts warnings that name what is wrong in the session before those that may follow from it.
//
// A tag that hangs elsewhere makes poses ambiguous, exchanged axes put readings outside the room: who reads the first warning
// should read the cause. Within both kinds, the order of the stages stays.
#ifndef LUXFIT_APPS_STAGES_WARNING_ORDER_H_
#define LUXFIT_APPS_STAGES_WARNING_ORDER_H_

#include <vector>

#include "inverse/fit/fit_room.h"

namespace luxfit {

void PutCausesFirst(std::vector<Warning>& warnings);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_WARNING_ORDER_H_
