// The one-standard-error rule over scores of candidates that stand in the order of their complexity.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_SIMPLEST_CHOICE_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_SIMPLEST_CHOICE_H_

#include <map>
#include <string>
#include <vector>

#include "inverse/choose/internal/left_out.h"
#include "inverse/select/detail_choice.h"

namespace luxfit {

// Taken is the first whose score exceeds the best one's by no more than the standard error of that
// difference, paired by groups, or by a tenth of the best: what repeats from group to group (a pose's error,
// the mesh's) is no evidence, however sure.
DetailChoice SimplestWithinOneStandardError(const std::vector<std::string>& names,
                                            const std::vector<std::map<int, GroupScore>>& scores);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_SIMPLEST_CHOICE_H_
