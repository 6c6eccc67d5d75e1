// Fits a luminaire from several starts where the first guess is ambiguous, and reports whether they agree.
//
// Each start is fitted to the data that concern the luminaire, with the others held, and scored by
// cross-validation (inverse/choose/internal/left_out.h). The
// best score is kept; the first start is kept where no other is better by more than a standard error, and one that photos
// show where no other leaves a third less.
//
// Starts that end within `same_place_m` of the kept place agree. A start that ends more than `other_place_m`
// away and is not worse by more than a standard error is a rival: the data do not tell the two places apart.
//
// Starts run in parallel. A luminaire with no other start is not fitted. Throws std::invalid_argument unless
// there is one list of starts for each luminaire.
// Source: Breiman, Friedman, Olshen, Stone (1984), sec. 3.4 (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_SEVERAL_STARTS_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_SEVERAL_STARTS_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct SeveralStartsOptions {
  int max_starts = 4;  // including the first
  double same_place_m = 0.01;
  double other_place_m = 0.1;
  int max_elements = 1000;
  int max_outer_iterations = 8;  // from far off, visibility changes along the way
  int max_inner_iterations = 12;
};

// Compares the starts of one luminaire. The first start is where it was.
struct StartComparison {
  int luminaire = 0;
  std::vector<Eigen::Vector3d> start;
  std::vector<Luminaire> end;
  std::vector<double> score;           // on data left out
  std::vector<double> standard_error;  // standard error of the difference from the best score
  int chosen = 0;
  int agreeing = 0;         // number of starts that agree, including the chosen
  std::vector<int> rivals;  // indices
};

struct SeveralStarts {
  LightState state;  // luminaires are where the chosen starts ended
  std::vector<StartComparison> comparisons;
};

// `rivals`: one list for each luminaire, of which position, aim and lobe are used. `own_priors`: what is known of the
// first start alone, such as the place that photos show.
SeveralStarts FitFromSeveralStarts(const Room& room, const LightData& data, const LightState& state,
                                   const std::vector<std::vector<Luminaire>>& rivals,
                                   const std::vector<ParameterPrior>& priors = {},
                                   const std::vector<ParameterPrior>& own_priors = {},
                                   const SeveralStartsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_SEVERAL_STARTS_H_
