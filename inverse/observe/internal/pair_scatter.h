// Estimates the variance component of values that come in pairs, robustly.
//
//   v_ab = n_ab + 2 s^2            variance of the difference of a pair
//   share(|d_ab| < 0.6745 sqrt v_ab) / share(|d_ab| < 2.5 sqrt v_ab) = 0.5 / 0.9876    the largest s that solves this
//
// d_ab: difference, n_ab: variance of its noise; each of both values has the component. Pairs beyond 2.5 sigma count nowhere: gross outliers bias s little as long as they are fewer than
// half of all pairs. Source: Rousseeuw and Croux (1993), Alternatives to the Median Absolute Deviation, for
// scales of pairwise differences. The limit at 2.5 sigma is the house's.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_PAIR_SCATTER_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_PAIR_SCATTER_H_

#include <vector>

namespace luxfit {

struct ScatterPair {
  double squared_difference = 0;
  double noise_variance = 0;  // of the difference
  double weight = 0;
};

// Returns s, between 0 and 1.
double ComponentOf(const std::vector<ScatterPair>& pairs);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_PAIR_SCATTER_H_
