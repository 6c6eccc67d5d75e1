// Selects the simplest candidate that data left out do not refuse: the one-standard-error rule.
//
//   chosen = argmin complexity over { c : score_c - score_best <= max(k SE(c, best), m score_best) }
//
// SE: the standard error of the paired difference (inverse/select/group_scores.h). Among candidates of equal complexity the
// better one is chosen, among equal ones the first. This is luxfit's only rule for choosing a model.
//
// Throws std::invalid_argument where no candidate is eligible.
// Source: Breiman, Friedman, Olshen, Stone (1984), "Classification and Regression Trees", sec. 3.4.
#ifndef LUXFIT_INVERSE_SELECT_ONE_STANDARD_ERROR_H_
#define LUXFIT_INVERSE_SELECT_ONE_STANDARD_ERROR_H_

#include <cstddef>
#include <vector>

#include "inverse/select/group_scores.h"

namespace luxfit {

struct SelectionCandidate {
  GroupScores scores;       // on data left out
  double complexity = 0;    // number of parameters, effective parameters, or rank
  bool is_eligible = true;  // false: listed with its score, never chosen
};

struct SelectionOptions {
  double standard_errors = 1;  // k
  // m: what a better candidate has to gain, as a share of the best score. Errors that repeat from group to group (a pose's, the
  // mesh's) are no evidence, however sure; a share of the score bounds them.
  double worth_having = 0;
  bool keeps_first =
      false;  // the first candidate is kept wherever it is within the margin, whatever its complexity
};

struct Selection {
  std::size_t best = 0, chosen = 0;  // indices of candidates
  std::vector<double> score,
      standard_error;  // one a candidate; the error is that of its difference from the best
};

Selection SimplestWithinOneStandardError(const std::vector<SelectionCandidate>& candidates,
                                         const SelectionOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_ONE_STANDARD_ERROR_H_
