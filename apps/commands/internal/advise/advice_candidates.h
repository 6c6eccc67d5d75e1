// Lists what advice compares: photos and readings that could be taken.
//
// Candidates are those of two tables, where they are given, instead of a grid over the room:
//
//   id,x_m,y_m,z_m,dx,dy,dz[,state]                 places of cameras; without state: in every one
//   id,x_m,y_m,z_m,nx,ny,nz,state[,illuminance_lx,sensor]    places of the meter, as a session has them
//
// Throws std::runtime_error naming file and line for places outside the room and unknown states.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_CANDIDATES_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_CANDIDATES_H_

#include <optional>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "inverse/advise/advise.h"

namespace luxfit {

struct AdviceCandidates {
  bool photos = true, readings = true;     // false: none of them
  std::string photo_table, reading_table;  // paths; empty: a grid
};

// Where candidates lie. Keeps references.
struct AdviceSetting {
  const Session& session;
  const Room& room;
  std::optional<Camera> camera;  // that photos would be taken with
  bool has_run = false;          // its readings are not taken again
  double spacing_m = kStandSpacingM;
};

// Photos are of the states of the session, readings on the grid of all states of `given`.
void AddCandidates(const AdviceSetting& setting, const AdviceCandidates& candidates, AdviceGiven& given);

// Adds the session's readings as quantities.
void AddPredicted(const Session& session, AdviceGiven& given);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_CANDIDATES_H_
