// Fits to as many of the observed elements as the answer needs.
//
// Elements are taken evenly in levels, each with about twice the elements of the one before: every s-th element,
// every s/2-th, ... all. Up to kFewTimes the elements of the first level, all are fitted at once. Beyond, the fit to
// a level is kept where twice as many elements would move no parameter by a tenth of its sigma or more
// (ShiftByPart in inverse/model/internal/intervals/parameter_shift.h). The elements that the fit has not seen predict that.
// Where they would, the fit is repeated, and the check with it. Independent errors fall with the root of their number,
// which says how many levels to go on.
//
// Rows of a facet share errors, so their information hardly grows with their number: the design effect grows with
// it from that of the first level.
//
// Source: Pereyra (1966) (deferred correction).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_ENOUGH_ROWS_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_ENOUGH_ROWS_H_

#include <vector>

#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/intervals/parameter_shift.h"

namespace luxfit {

constexpr int kFewTimes = 4;

// Says what twice as many elements as were fitted would do.
struct RowDoubling {
  int elements = 0;
  LargestShift effect;
};

struct TakenRows {
  std::vector<RowDoubling> doublings;  // in the order of the fits; empty: all elements were fitted at once
  int elements = 0, observed_elements = 0;
};

struct EnoughRows {
  LuminaireFit fit;
  std::vector<Observation> observations;  // those of `fit`
  TakenRows taken;
};

// `first_elements`: about how many elements the first level has, as ThinElements takes them. `options`: of the
// fits, with the design effect of the first level, which is known (at least 1).
EnoughRows FitToEnoughRows(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors, int first_elements,
                           const FitLuminairesOptions& options);

// Returns the level of each observation, from 0. Level 0 has the elements that ThinElements takes.
std::vector<int> LevelsOf(const std::vector<Observation>& observations, int first_elements);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_ENOUGH_ROWS_H_
