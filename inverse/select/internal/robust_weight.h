// Weighs a residual by Cauchy's loss, so that strays lose their say.
//
//   rho(z) = k^2 ln(1 + (z / k)^2),   w(z) = rho'(z) / (2 z) = 1 / (1 + (z / k)^2)
//
// z: residual over its sigma; k, in sigmas, is where the weight is 1/2. Least squares with weights that are
// refreshed between the steps (IRLS) end at a minimum of the sum of rho.
//
// Source: Holland and Welsch (1977), "Robust regression using iteratively reweighted least-squares".
#ifndef LUXFIT_INVERSE_SELECT_INTERNAL_ROBUST_WEIGHT_H_
#define LUXFIT_INVERSE_SELECT_INTERNAL_ROBUST_WEIGHT_H_

#include <cmath>

namespace luxfit {

inline double CauchyWeight(double z, double k) {
  const double share = z / k;
  return 1 / (1 + share * share);
}

inline double CauchyLoss(double z, double k) {
  const double share = z / k;
  return k * k * std::log1p(share * share);
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_SELECT_INTERNAL_ROBUST_WEIGHT_H_
