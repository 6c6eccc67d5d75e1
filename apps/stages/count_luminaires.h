// Luminaires that no [states] names.
#ifndef LUXFIT_APPS_STAGES_COUNT_LUMINAIRES_H_
#define LUXFIT_APPS_STAGES_COUNT_LUMINAIRES_H_

#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// The session with as many luminaires more ("lamp1", ...) as its light comes from, all on in its only state;
// as it is where their number is known. Records the choice; warns ("luminaires_not_counted") where too little
// light was seen, and ("luminaires_at_max") where more than luminaires.max may be there.
Session WithCountedLuminaires(Session session, const Room& room, const std::vector<Observation>& observations,
                              RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_COUNT_LUMINAIRES_H_
