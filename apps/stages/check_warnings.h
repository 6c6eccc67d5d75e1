// Warns of what the readings that check say against a fit: the verdicts of `luxfit check`, in its words.
//
// What is more than 5 % off leaves the result undetermined: all readings together, most of a state, or one alone beyond
// what chance does among so many (inverse/check/luxmeter_check.h). Less is a warning.
#ifndef LUXFIT_APPS_STAGES_CHECK_WARNINGS_H_
#define LUXFIT_APPS_STAGES_CHECK_WARNINGS_H_

#include <vector>

#include "inverse/check/luxmeter_check.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

// `readings`: those that check, were measured, and have a prediction.
void WarnOfCheck(const std::vector<NamedReading>& readings, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CHECK_WARNINGS_H_
