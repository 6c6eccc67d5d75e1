// Estimates how much views of one element disagree beyond their noise: one number for all elements and views.
//
//   y_v = mu (1 + s e_v) + noise_v                    e_v ~ N(0, 1), var noise_v = n_v
//   d_ab = 2 (y_a - y_b) / (y_a + y_b)                relative difference of a pair of views
//   sigma_ab^2 = 2 s^2 + 4 (n_a + n_b) / (y_a + y_b)^2
//   s: inverse/observe/internal/pair_scatter.h
//
// y_v: relative luminance of one element in one state. s is the relative variance component between views:
// registration, vignetting, gloss, interpolation within the element. It is taken over all pairs of
// different views of an element and state; a pair of m views weighs 2 / m, so that m views count as their m -
// 1 degrees of freedom.
//
// Differences of pairs need no centre, so groups of all sizes have one distribution. Errors that all views of
// an element share are not seen; the fit's model error holds those. Source: Searle, Casella, McCulloch (1992),
// Variance Components, for the model.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_BETWEEN_VIEWS_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_BETWEEN_VIEWS_H_

#include <vector>

#include "inverse/observe/observe.h"

namespace luxfit {

BetweenViews EstimateBetweenViews(const std::vector<Observation>& observations);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_BETWEEN_VIEWS_H_
