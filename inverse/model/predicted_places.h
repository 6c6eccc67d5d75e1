// Illuminance at any places by the luminaires of a fit, one column each, with what the fit's covariance says
// of it.
//
//   E_ik = Phi_k E_k(place i),   E_i(d) = sum_k d_k E_ik                                        lx
//   Cov(E) = J Sigma J^T ~ S S^T,    J = dE / dtheta by the model that was fitted (inverse/model/light_model.h)
//
// Rows of S are (place, luminaire), the luminaire fastest; its columns the directions in which the
// predictions vary most, as many as leave out less than a thousandth of the variance. So any sum of columns
// (a state, a mean over places) has its sigma: |sum of rows|.
//
// Parameters that no prediction depends on (the camera's scale) are passed over. Those that would matter and are none
// of these luminaires and materials stand in `left_out`, and sigmas are then too small. Rooms so large that their transport is sparse have
// no derivatives: S is empty.
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
  Eigen::MatrixXd factor;               // S; empty: not known
  std::vector<ParameterId> left_out;
};
PredictedPlaces PredictPlaces(const Room& room, const std::vector<Luminaire>& luminaires,
                              const Eigen::VectorXd& albedo, const std::vector<Sensor>& places,
                              const ParameterCovariance& known);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_PREDICTED_PLACES_H_
