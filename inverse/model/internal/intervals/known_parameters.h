// Finds the parameters of an earlier fit again in the light model of its room.
//
// AllFree has every parameter free that a fit may free, but for scales of camera and meter: which of them the
// earlier fit had, its covariance says. Luminaires of one type count as different: what they share changes the first
// one's light alone.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_KNOWN_PARAMETERS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_KNOWN_PARAMETERS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "inverse/model/fit_uncertainty.h"
#include "inverse/model/light_state.h"

namespace luxfit {

LightState AllFree(const Room& room, const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo);

struct KnownParameters {
  std::vector<Parameter> parameters;
  Eigen::MatrixXd covariance;
  std::vector<ParameterId> left_out;  // parameters that change light and are not among `possible`
};
KnownParameters FindKnown(const std::vector<Parameter>& possible, const ParameterCovariance& given);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_INTERVALS_KNOWN_PARAMETERS_H_
