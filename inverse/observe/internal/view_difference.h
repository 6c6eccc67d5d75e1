// Compares two views of one element over the states that both show.
//
//   d_s = ln Y_as - ln Y_bs,  n_s: variance of its noise
//   ln N(d; 0, diag(n + 2 r^2) + 2 c^2 1 1^T)
//
// d has a part that is common to all states, and a part of each state.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_VIEW_DIFFERENCE_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_VIEW_DIFFERENCE_H_

#include <Eigen/Core>

#include "inverse/observe/internal/view_table.h"

namespace luxfit {

struct ViewDifference {
  int states = 0;               // that both views show; 0: nothing can be said
  Eigen::ArrayXd value, noise;  // of these states
  double common = 0;            // mean over states
  double common_noise = 0;      // its variance
};

ViewDifference DifferenceOf(const ViewTable& table, int a, int b);

// Returns the logarithm of the density but for (2 pi)^(-states/2).
double LogDensity(const ViewDifference& difference, double common_variance, double state_variance);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_VIEW_DIFFERENCE_H_
