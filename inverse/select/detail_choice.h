// Chooses how much detail a model needs, and keeps what it was chosen among.
#ifndef LUXFIT_INVERSE_SELECT_DETAIL_CHOICE_H_
#define LUXFIT_INVERSE_SELECT_DETAIL_CHOICE_H_

#include <string>
#include <vector>

#include "inverse/select/group_scores.h"

namespace luxfit {

struct DetailCandidate {
  std::string name;
  double score = 0;           // mean of min(z^2, 9) on what was left out
  double standard_error = 0;  // of its difference from the best
};

struct DetailChoice {
  std::vector<DetailCandidate> among;  // the simplest first; empty: nothing was compared
  int chosen = 0;

  const DetailCandidate& Chosen() const { return among[static_cast<size_t>(chosen)]; }
};

// By SimplestWithinOneStandardError; more detail has to gain a tenth of the best score as well.
DetailChoice ChooseDetail(const std::vector<std::string>& names, const std::vector<GroupScores>& scores);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_DETAIL_CHOICE_H_
