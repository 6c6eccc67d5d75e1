// Chooses how much detail a model needs, and keeps the candidates with their scores.
//
// The rule is SimplestWithinOneStandardError (inverse/select/one_standard_error.h). More detail must also
// gain a tenth of the best score. Throws as that function does.
#ifndef LUXFIT_INVERSE_SELECT_INTERNAL_DETAIL_CHOICE_H_
#define LUXFIT_INVERSE_SELECT_INTERNAL_DETAIL_CHOICE_H_

#include <string>
#include <vector>

#include "inverse/select/one_standard_error.h"

namespace luxfit {

struct DetailCandidate {
  std::string name;
  double score = 0;           // mean of min(z^2, 9) on data left out
  double standard_error = 0;  // standard error of the difference from the best
};

struct DetailChoice {
  std::vector<DetailCandidate> among;  // simplest first; empty: nothing was compared
  int chosen = 0;

  const DetailCandidate& Chosen() const { return among[static_cast<size_t>(chosen)]; }
};

// `names` and `scores` have one entry for each candidate, the simplest first.
DetailChoice ChooseDetail(const std::vector<std::string>& names, const std::vector<GroupScores>& scores);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_INTERNAL_DETAIL_CHOICE_H_
