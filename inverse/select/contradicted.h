// Says whether data left out contradict what is given: the rule of choices at its strictest.
//
//   score_given - score_rival > max(2 SE, score_rival)      inverse/select/one_standard_error.h
//
// A rival has to halve the score, by more than two standard errors. Source: the rule's; both limits are the house's.
#ifndef LUXFIT_INVERSE_SELECT_CONTRADICTED_H_
#define LUXFIT_INVERSE_SELECT_CONTRADICTED_H_

#include "inverse/select/one_standard_error.h"

namespace luxfit {

// Both must have the same groups with the same counts, one group or more.
bool IsContradicted(const GroupScores& given, const GroupScores& rival);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_CONTRADICTED_H_
