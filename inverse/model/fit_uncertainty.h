// Holds how well a fit knows what it found, and propagates it to positions, fluxes and the light at any
// places.
//
//   E_ik = Phi_k E_k(place i),   E_i(d) = sum_k d_k E_ik                                        lx
//   Cov(E) = J Sigma J^T ~ S S^T,    J = dE / dtheta by the fitted model (internal/light_model.h)
//
// Parameters theta are as fitted: positions in m; fluxes, exponents and scales as logarithms, so that their
// sigma is relative; reflectances as they are. A value that the fit held has no parameter and no uncertainty.
// A parameter that the data did not determine has a sigma of NaN.
//
// Rows of S are (place, luminaire), the luminaire fastest. Its columns are the directions in which the
// predictions vary most; those left out hold less than a thousandth of the variance. Any weighted sum of
// predictions (a state, a mean over places) therefore has the sigma |sum of rows|.
//
// Parameters on which no prediction depends (the camera's scale) are ignored. Parameters that matter but
// belong to none of these luminaires and materials are listed in `left_out`; sigmas are then too small. S is
// empty for rooms so large that their transport is sparse: they have no derivatives.
//
// PredictPlaces throws std::invalid_argument where the covariance is not as large as the list of parameters.
// Source: JCGM 102:2011, sec. 6 (propagation for several outputs).
#ifndef LUXFIT_INVERSE_MODEL_FIT_UNCERTAINTY_H_
#define LUXFIT_INVERSE_MODEL_FIT_UNCERTAINTY_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/light/room.h"
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

struct PredictedPlaces {
  Eigen::MatrixXd total_lx, direct_lx;  // places x luminaires
  Eigen::MatrixXd factor;               // S; empty: unknown
  std::vector<ParameterId> left_out;
};
PredictedPlaces PredictPlaces(const Room& room, const std::vector<Luminaire>& luminaires,
                              const Eigen::VectorXd& albedo, const std::vector<Sensor>& places,
                              const ParameterCovariance& known);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_FIT_UNCERTAINTY_H_
