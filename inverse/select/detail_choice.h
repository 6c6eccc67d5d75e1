// The simplest of several models, by what each leaves of observations left out.
#ifndef LUXFIT_INVERSE_SELECT_DETAIL_CHOICE_H_
#define LUXFIT_INVERSE_SELECT_DETAIL_CHOICE_H_

#include <string>
#include <vector>

namespace luxfit {

struct DetailCandidate {
  std::string name;
  double score = 0;           // mean of min(z^2, 9) on what was left out
  double standard_error = 0;  // of its difference from the best
};

struct DetailChoice {
  std::vector<DetailCandidate> among;  // the simplest first; empty: nothing was compared
  int chosen = 0;                      // the first within one standard error of the best

  const DetailCandidate& Chosen() const { return among[static_cast<size_t>(chosen)]; }
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_DETAIL_CHOICE_H_
