// Ends a fit on request, with what it has.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_EARLY_STOP_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_EARLY_STOP_H_

#include <atomic>
#include <functional>
#include <string>

#include "inverse/fit/fit_room.h"

namespace luxfit {

// Returns a LightData::checkpoint that counts rounds and throws FitStopped with the reason that stop_reason
// (FitRoomOptions::stop_reason, which may be empty) gives. `rounds` has to outlive it.
std::function<void(bool is_part)> CheckpointOf(const std::function<std::string()>& stop_reason,
                                               std::atomic<int>& rounds);

// Warns ("fit_stopped") that the fit is not done. What was asked for is then undetermined.
void WarnOfStop(const EarlyStop& stop, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_EARLY_STOP_H_
