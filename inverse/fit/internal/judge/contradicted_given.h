// Finds what is given of luminaires with a sigma and contradicted by all other data: a place, a flux.
//
//   z^2 = sum over axes (x_fit - x_given)^2 / (sigma_given^2 + sigma_fit^2)     a place, m;   limit 14.16: chi-squared, 3 degrees of freedom
//   z = (ln Phi_fit - ln Phi_given) / sigma_given                               a flux;       limit 3, and 5 % of the flux
//
// Both limits leave 0.27 % to chance. The fit has taken what is given as a prior, so that it lies nearer to it than the
// other data alone would: what it leaves all the same is contradicted. sigma_fit makes up for errors of the fit that are not
// chance; that of a flux grows with the contradiction itself, and small errors of fluxes are the model's.
//
// Source: Wald's test; Gelman et al. (2013), "Bayesian Data Analysis", sec. 6.3 (checks of the prior by what was fitted).
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_CONTRADICTED_GIVEN_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_CONTRADICTED_GIVEN_H_

#include <vector>

#include "inverse/fit/fit_room.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

struct ContradictedGiven {
  std::vector<int> places, fluxes;  // luminaires, as `given` numbers them
};
ContradictedGiven FindContradictedGiven(const RoomObservations& given, const RoomFit& fit);

RoomObservations WithoutPlacesOf(const std::vector<int>& luminaires, RoomObservations given);

// Warns ("given_contradicted") where a place was left out: `fit` is the one without it. `fit_as_given` has taken it.
void WarnOfPlaceLeftOut(const KnownLuminaire& given, const RoomFit& fit, const RoomFit& fit_as_given,
                        Findings& findings);

// Warns of a place, or a flux, that the fit took and that the other data contradict: nothing tells which is right.
void WarnOfPlace(const KnownLuminaire& given, const RoomFit& fit, Findings& findings);
void WarnOfFlux(const KnownLuminaire& given, const RoomFit& fit, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_CONTRADICTED_GIVEN_H_
