// Predicts the illuminance that a fit's luminaires give at any places, with its covariance from the fit.
//
//   E_ik = Phi_k E_k(place i),   E_i(d) = sum_k d_k E_ik                                        lx
//   Cov(E) = J Sigma J^T ~ S S^T,    J = dE / dtheta by the fitted model (internal/light_model.h)
//
// Rows of S are (place, luminaire), the luminaire fastest. Its columns are the directions in which the
// predictions vary most; those left out hold less than a thousandth of the variance. Any weighted sum of
// predictions (a state, a mean over places) therefore has the sigma |sum of rows|.
//
// Parameters on which no prediction depends (the camera's scale) are ignored. Parameters that matter but
// belong to none of these luminaires and materials are listed in `left_out`; sigmas are then too small. S is
// empty for rooms so large that their transport is sparse: they have no derivatives.
//
// Throws std::invalid_argument where the covariance is not as large as the list of parameters.
// Source: JCGM 102:2011, sec. 6 (propagation for several outputs).
#ifndef LUXFIT_INVERSE_MODEL_PREDICTED_PLACES_H_
#define LUXFIT_INVERSE_MODEL_PREDICTED_PLACES_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "inverse/model/parameter.h"

namespace luxfit {

struct ParameterCovariance {
  std::vector<ParameterId> parameters;
  Eigen::MatrixXd covariance;
};

struct PredictedPlaces {
  Eigen::MatrixXd total_lx, direct_lx;  // places x luminaires
  Eigen::MatrixXd factor;               // S; empty: unknown
  std::vector<ParameterId> left_out;
};
PredictedPlaces PredictPlaces(const Room& room, const std::vector<Luminaire>& luminaires,
                              const Eigen::VectorXd& albedo, const std::vector<Sensor>& places,
                              const ParameterCovariance& known);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_PREDICTED_PLACES_H_
