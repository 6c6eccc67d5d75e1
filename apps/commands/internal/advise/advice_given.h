// Makes what advice on a run starts from: its fit, the photos it had, and what could be taken next.
//
// The states are those of the session. Readings may also be taken with each luminaire alone, in states that follow
// them.
//
// Throws std::runtime_error where OUT/stages/fit.json lacks the covariance, and as AddCandidates does.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_GIVEN_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_GIVEN_H_

#include <string>
#include <vector>

#include "apps/commands/internal/advise/advice_candidates.h"
#include "apps/export/fitted_room.h"
#include "inverse/advise/room_guess.h"

namespace luxfit {

// One state of AdviceGiven::dimming.
struct AdviceState {
  std::string name;     // "B", or "B alone" where the session has no such state
  bool is_new = false;  // the session does not have it
};

struct SessionAdvice {
  AdviceGiven given;
  std::vector<AdviceState> states;
  std::vector<Assumption> assumed;  // of a session without a run
};
SessionAdvice SessionAdviceOf(const FittedRoom& fitted, const AdviceCandidates& candidates);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_GIVEN_H_
