// Reads how well an earlier fit knows what it found: the covariance of OUT/stages/fit.json by parameters.
//
// Parameters are as fitted: positions m, fluxes, exponents and scales as logarithms (so their sigma is
// relative), albedo as it is. What the fit held has no parameter and no uncertainty; what the data did not
// determine has a sigma of NaN.
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
  std::vector<bool> is_determined;  // one a parameter
  Eigen::MatrixXd covariance;       // empty: the fit did not get that far
  double relative_model_sigma = 0;

  std::vector<ParameterId> Undetermined() const;
  bool Has(const ParameterId& parameter) const;
  double Covariance(const ParameterId& a, const ParameterId& b) const;  // 0 where either was held
  double Sigma(const ParameterId& parameter) const;
};
// Of the run that wrote into this folder.
FitUncertainty ReadFitUncertainty(const std::string& out);

// Camera scale times reflectance, with what is known of each: reflectances that the data did not determine,
// or that nobody saw, are unknown.
SurfaceScale ScaleOfSurfaces(const FittedRoom& fitted, const FitUncertainty& uncertainty);

// Of a luminaire's position, m2; zero for what the fit held, NaN for what the data did not determine.
Eigen::Matrix3d PositionCovariance(const FitUncertainty& uncertainty, const std::string& luminaire);

// Covariance of ln flux, luminaires x luminaires.
Eigen::MatrixXd FluxCovariance(const FittedRoom& fitted, const FitUncertainty& uncertainty);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_FIT_UNCERTAINTY_H_
