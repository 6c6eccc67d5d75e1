// Makes what advice on a run starts from: its fit, the photos it had, and what could be taken next.
//
// The states are those of the session. Readings may also be taken with each luminaire alone, in states that follow
// them. Candidates are those of two tables, where they are given, instead of a grid over the room:
//
//   id,x_m,y_m,z_m,dx,dy,dz[,state]                 places of cameras; without state: in every one
//   id,x_m,y_m,z_m,nx,ny,nz,state[,illuminance_lx,sensor]    places of the meter, as a session has them
//
// Throws std::runtime_error naming file and line for places outside the room and unknown states, and where
// OUT/stages/fit.json lacks the covariance.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_ADVICE_GIVEN_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_ADVICE_GIVEN_H_

#include <string>
#include <vector>

#include "apps/export/fitted_room.h"
#include "inverse/advise/advise.h"

namespace luxfit {

struct AdviceCandidates {
  bool photos = true, readings = true;     // false: none of them
  std::string photo_table, reading_table;  // paths; empty: a grid
};

// One state of AdviceGiven::dimming.
struct AdviceState {
  std::string name;     // "B", or "B alone" where the session has no such state
  bool is_new = false;  // the session does not have it
};

struct SessionAdvice {
  AdviceGiven given;
  std::vector<AdviceState> states;
};
SessionAdvice SessionAdviceOf(const FittedRoom& fitted, const AdviceCandidates& candidates);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_ADVICE_GIVEN_H_
