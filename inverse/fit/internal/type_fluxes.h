// Compares the fluxes of luminaires of one type, as commissioning does.
//
//   z_k = (ln Phi_k - median) / sqrt(s^2 + sigma_k^2),   s = 1.4826 median |ln Phi - median|
//
// sigma_k: of ln Phi_k against the mean of its type, so that errors that all fluxes share cancel. A flux
// deviates where as large a |z| comes once in a hundred rooms of as many luminaires (Bonferroni).
//
// Fewer than four luminaires do not tell their spread: then none deviates.
// Source: Iglewicz and Hoaglin (1993), "How to detect and handle outliers" (modified z).
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_TYPE_FLUXES_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_TYPE_FLUXES_H_

#include <vector>

#include "inverse/fit/fit_room.h"

namespace luxfit {

// Returns the types of two and more luminaires whose fluxes were fitted.
std::vector<LuminaireType> CompareTypeFluxes(const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_TYPE_FLUXES_H_
