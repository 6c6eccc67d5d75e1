// Decides whether the photos of a state hold more or less ambient light than was subtracted from them.
//
//   b^T C^-1 b <= chi2_95(states)      else the shares stay free
//
// b: LightState::ambient_share as fitted, of the states of which the data tell it, C: their covariance. Where all of them
// together are not told from 0, they are held there.
// Sources: Wald (1943), "Tests of statistical hypotheses concerning several parameters"; Wilson and Hilferty (1931), "The distribution of
// chi-square", for its quantile.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_AMBIENT_LEFT_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_AMBIENT_LEFT_H_

#include <vector>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct AmbientLeft {
  std::vector<int> states;       // of which the data tell the share
  Eigen::VectorXd share, sigma;  // of these
  double chi2 = 0, chi2_95 = 0;
  bool IsNeeded() const { return chi2 > chi2_95; }
  // Returns the root mean square of the shares where they are needed, else 0.
  double Spread() const;
};

// None without a covariance. `prior_sigma`: of each share.
AmbientLeft AmbientLeftIn(const LuminaireFit& fit, double prior_sigma);

// Returns the readings with sigmas that hold ambient light which changed by `spread` (1 sigma, relative).
std::vector<Reading> WithAmbientSpread(std::vector<Reading> readings, double spread);

// Returns the state with all ambient light subtracted as it was, held.
LightState WithoutAmbientLeft(LightState state);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_DETAIL_AMBIENT_LEFT_H_
