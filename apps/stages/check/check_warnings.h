// Warns of what the readings that check say against a fit: the verdicts of `luxfit check`, in its words.
//
// An error of more than 5 % leaves the result undetermined: one of all readings together, of most readings of a state,
// or of one reading beyond what chance does among so many (inverse/check/luxmeter_check.h). A smaller one is a warning.
#ifndef LUXFIT_APPS_STAGES_CHECK_CHECK_WARNINGS_H_
#define LUXFIT_APPS_STAGES_CHECK_CHECK_WARNINGS_H_

#include <vector>

#include "inverse/check/luxmeter_check.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

// `readings`: those that check, were measured, and have a prediction.
void WarnOfCheck(const std::vector<NamedReading>& readings, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CHECK_CHECK_WARNINGS_H_
