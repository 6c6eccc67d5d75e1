// Returns relative sigmas of a fit's reflectances, by material; 0 where the fit held or did not determine one.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_REFLECTANCE_SIGMA_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_REFLECTANCE_SIGMA_H_

#include <Eigen/Core>

#include "inverse/model/fit_luminaires.h"

namespace luxfit {

Eigen::VectorXd SigmaOfReflectances(const Room& room, const LuminaireFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_REFLECTANCE_SIGMA_H_
