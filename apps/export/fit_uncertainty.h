// Reads how well an earlier fit knows what it found: the covariance of OUT/stages/fit.json by parameters.
//
// Parameters are as fitted: positions in m; fluxes, exponents and scales as logarithms (so that their sigma
// is relative); albedo as it is. A value that the fit held has no parameter and no uncertainty. A parameter
// that the data did not determine has a sigma of NaN.
//
// Throws std::runtime_error naming the file where it is missing or of another kind.
#ifndef LUXFIT_APPS_EXPORT_FIT_UNCERTAINTY_H_
#define LUXFIT_APPS_EXPORT_FIT_UNCERTAINTY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/export/fitted_room.h"
#include "inverse/control/lux_map.h"
#include "inverse/model/parameter.h"

namespace luxfit {

struct FitUncertainty {
  std::vector<ParameterId> parameters;
  Eigen::VectorXd values;
  std::vector<bool> is_determined;  // by parameter
  Eigen::MatrixXd covariance;       // empty: the fit ended before
  double relative_model_sigma = 0;

  std::vector<ParameterId> Undetermined() const;
  bool Has(const ParameterId& parameter) const;
  double Covariance(const ParameterId& a, const ParameterId& b) const;  // 0 where either was held
  double Sigma(const ParameterId& parameter) const;
};
// Reads the uncertainty of the run that wrote into this folder.
FitUncertainty ReadFitUncertainty(const std::string& out);

// Returns camera scale times reflectance, with the uncertainty of each. Reflectances that the data did not
// determine, or that no photo shows, are unknown.
SurfaceScale ScaleOfSurfaces(const FittedRoom& fitted, const FitUncertainty& uncertainty);

// Returns the covariance of a luminaire's position, m2. It is zero where the fit held the position, and NaN
// where the data did not determine it.
Eigen::Matrix3d PositionCovariance(const FitUncertainty& uncertainty, const std::string& luminaire);

// Returns the covariance of ln flux, luminaires x luminaires.
Eigen::MatrixXd FluxCovariance(const FittedRoom& fitted, const FitUncertainty& uncertainty);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_FIT_UNCERTAINTY_H_
