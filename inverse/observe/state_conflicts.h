// Finds where photos contradict what is said to be on: a luminaire's place is bright in a state in which it is said to be
// off, or dark in one in which it is dimmed no lower than where it is bright.
//
// Places are those of FindSeenLuminaires; a luminaire's own is within three sigmas of it and bright in a state in which it
// is on. Where another luminaire that is on hangs as near, nothing is said.
#ifndef LUXFIT_INVERSE_OBSERVE_STATE_CONFLICTS_H_
#define LUXFIT_INVERSE_OBSERVE_STATE_CONFLICTS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct StateConflict {
  int luminaire = 0, state = 0;
  bool is_bright = false;  // said to be off, and bright; else said to be on, and dark
};

// `dimming`: one vector for each state, by luminaire.
std::vector<StateConflict> FindStateConflicts(const std::vector<SeenPlace>& seen,
                                              const std::vector<Luminaire>& luminaires,
                                              const std::vector<Eigen::VectorXd>& dimming);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_STATE_CONFLICTS_H_
