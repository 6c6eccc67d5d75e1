// Estimates the ambient light of a room, such as daylight, and how much of it each photo shows.
//
//   Y_evs = R_es + a_vs O_ev + noise
//
// Y: relative luminance of element e in view v and state s of the luminaires, R: what the luminaires give, O: the same with all
// luminaires off, a: the share of that light that is there in state s; 1 where the light is steady.
//
// O is the view's own photo with all luminaires off. Where a view has none, O is the mean of the others' at the elements that they
// show: off photos of several views differ by a factor, ln O_ev = ln A_e + g_v, where the light changed between them.
//
// Views that show the same element in the same state tell a, whatever R is:
//
//   Y_evs - Y_ews = a_vs O_ev - a_ws O_ew
//   sum_s n_s Y_evs = sum_s n_s a_vs O_ev          n: states whose light of luminaires adds up to none, all less each one
//
// by robust least squares, with the prior a = 1 +- kShareSigma. What may be light of luminaires all the same (one number for each) is left to
// the fit, which knows what luminaires can give (ParameterKind::kAmbientShare). Whether shares are needed is decided on data left out:
// 1 is the simpler model, by one standard error and kWorthHaving.
//
// Source: own; Holland and Welsch (1977) for the weights; inverse/select/one_standard_error.h.
#ifndef LUXFIT_INVERSE_OBSERVE_AMBIENT_LIGHT_H_
#define LUXFIT_INVERSE_OBSERVE_AMBIENT_LIGHT_H_

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "forward/room/patches.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Dusk takes a third of the light in the time that photos of a room take.
constexpr double kShareSigma = 0.3;

struct AmbientLight {
  std::map<std::pair<int, int>, Observation> off;  // O, by view and element, where it is known
  std::map<std::pair<int, int>, double> share;     // a, by view and state; empty: 1
  double score_of_ones = 0, score_of_shares = 0;   // on data left out: mean of min(z^2, 9)
  double spread = 0;  // standard deviation of the ambient light from photo to photo, relative

  double ShareOf(int view, int state) const {
    const auto found = share.find({view, state});
    return found == share.end() ? 1 : found->second;
  }
};

// `observations`: of all photos, as they are, those with all luminaires off too. `dimming`: by state, of every luminaire; all 0 where
// they are off.
AmbientLight EstimateAmbientLight(const Patches& patches, const std::vector<Observation>& observations,
                                  const std::vector<Eigen::VectorXd>& dimming);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AMBIENT_LIGHT_H_
