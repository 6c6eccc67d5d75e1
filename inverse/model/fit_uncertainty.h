// Holds how well a fit knows what it found, and propagates it to positions and fluxes. What it says of the light at any
// place: inverse/model/fitted_light.h.
//
// Parameters theta are as fitted: positions in m; fluxes, exponents and scales as logarithms, so that their
// sigma is relative; reflectances as they are. A value that the fit held has no parameter and no uncertainty.
// A parameter that the data did not determine has a sigma of NaN.
#ifndef LUXFIT_INVERSE_MODEL_FIT_UNCERTAINTY_H_
#define LUXFIT_INVERSE_MODEL_FIT_UNCERTAINTY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/luminaire/luminaire.h"
#include "inverse/model/parameter.h"

namespace luxfit {

struct LuminaireFit;  // inverse/model/fit_luminaires.h

struct ParameterCovariance {
  std::vector<ParameterId> parameters;
  Eigen::MatrixXd covariance;
};

// The covariance is empty where the fit ended before it had one.
struct FitUncertainty : ParameterCovariance {
  Eigen::VectorXd values;           // by parameter
  std::vector<bool> is_determined;  // by parameter
  double relative_model_sigma = 0;  // common to all predictions

  std::vector<ParameterId> Undetermined() const;
  double Covariance(const ParameterId& a, const ParameterId& b) const;  // 0 where either was held
  double Sigma(const ParameterId& parameter) const;
};
FitUncertainty UncertaintyOf(const LuminaireFit& fit);

// Returns the covariance of a luminaire's position, m2. It is zero where the fit held the position, and NaN
// where the data did not determine it.
Eigen::Matrix3d PositionCovariance(const FitUncertainty& fit, const std::string& luminaire);

// Returns the covariance of ln flux, luminaires x luminaires.
Eigen::MatrixXd FluxCovariance(const FitUncertainty& fit, const std::vector<Luminaire>& luminaires);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_FIT_UNCERTAINTY_H_
