// A luminaire fitted from several starts, where the first guess is ambiguous: the best is kept, and whether
// they agree is told.
//
// Each start is fitted to four fifths of the data that speak of the luminaire, the others held, and scored on
// the rest (inverse/choose/internal/left_out.h), all with one common model error. The best score is kept, the first
// start where another is not better by more than a standard error. Starts that end within `same_place_m` of
// its place agree; one that ends more than `other_place_m` away and is not worse by more than a standard
// error is a rival: the data do not tell the two places apart.
//
// Starts run in parallel. A luminaire with no other start is not fitted. Throws std::invalid_argument unless
// there is one list of starts a luminaire.
// Source: Breiman, Friedman, Olshen, Stone (1984), sec. 3.4 (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_SEVERAL_STARTS_H_
#define LUXFIT_INVERSE_CHOOSE_SEVERAL_STARTS_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct SeveralStartsOptions {
  int max_starts = 4;  // with the first
  double same_place_m = 0.01;
  double other_place_m = 0.1;
  int max_elements = 1000;
  int max_outer_iterations = 8;  // from far off, visibility changes on the way
  int max_inner_iterations = 12;
};

// Of one luminaire; the first start is where it was.
struct StartComparison {
  int luminaire = 0;
  std::vector<Eigen::Vector3d> start, end;
  std::vector<double> score;           // on what was left out
  std::vector<double> standard_error;  // of its difference from the best score
  int chosen = 0;
  int agreeing = 0;         // of all starts, the chosen included
  std::vector<int> rivals;  // indices
};

struct SeveralStarts {
  LightState state;  // with the luminaires as the chosen starts ended
  std::vector<StartComparison> comparisons;
};

// `rivals`, one list a luminaire: position, aim and lobe of each count.
SeveralStarts FitFromSeveralStarts(const Room& room, const LightData& data, const LightState& state,
                                   const std::vector<std::vector<Luminaire>>& rivals,
                                   const std::vector<ParameterPrior>& priors = {},
                                   const SeveralStartsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_SEVERAL_STARTS_H_
