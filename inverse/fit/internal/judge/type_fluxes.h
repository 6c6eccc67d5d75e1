// Compares the fluxes of luminaires of one type, as commissioning does.
//
//   z_k = (ln Phi_k - median) / sqrt(s^2 + sigma_k^2)
//   s^2 = (nu_0 s_0^2 + nu m^2) / (nu_0 + nu),   m = 1.4826 median |ln Phi - median|,   nu = 0.37 (n - 1)
//
// sigma_k: of ln Phi_k against the mean of its type, so that errors that all fluxes share cancel. n luminaires tell
// their spread m with about nu degrees of freedom; few may be alike by chance. s_0 is what makers allow, +-10 % as
// three sigma, with nu_0 = 4. z_k has Student's distribution, its degrees of freedom by Welch and Satterthwaite. A
// flux deviates where as large a |z| comes once in a hundred rooms of as many luminaires (Bonferroni).
//
// Two luminaires do not tell which of them deviates: then none does.
// Sources: Iglewicz and Hoaglin (1993), "How to detect and handle outliers" (modified z); Rousseeuw and Croux (1993),
// "Alternatives to the median absolute deviation" (its efficiency of 37 %); Gelman et al. (2013), "Bayesian data
// analysis", sec. 2.6 (variances pooled with a prior); Satterthwaite (1946); IEC 62722-2-1 (tolerance of flux).
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_TYPE_FLUXES_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_TYPE_FLUXES_H_

#include <vector>

#include "inverse/fit/fit_room.h"

namespace luxfit {

// Returns the types of two and more luminaires whose fluxes were fitted.
std::vector<LuminaireType> CompareTypeFluxes(const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_TYPE_FLUXES_H_
