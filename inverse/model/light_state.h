// Holds what a fit varies: luminaires, reflectances and scales, and the parameters that are free of them.
//
// Free parameters are stacked in one vector: fluxes, exponents and the scales of camera and meter as logarithms, so that they
// stay positive and scales separate; positions and sizes in metres; tilts and headings in radians from the parameter's frame.
#ifndef LUXFIT_INVERSE_MODEL_LIGHT_STATE_H_
#define LUXFIT_INVERSE_MODEL_LIGHT_STATE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/parameter.h"

namespace luxfit {

// What is free of one luminaire.
struct FreeQuantities {
  bool position = true;
  bool flux = true;
  bool exponent = false;
  bool size = false;
  bool tilt = false;
  bool heading = false;
  // > 0: the shares of its table's nodes or of its cells are free, their smoothness known to so much
  // (inverse/model/internal/part_smoothness.h).
  double table_sigma = 0;
  double emission_sigma = 0;
};

struct LightState {
  std::vector<Luminaire> luminaires;
  std::vector<FreeQuantities> free;  // one a luminaire
  Eigen::VectorXd albedo;            // by material
  std::vector<bool> albedo_free;
  double camera_scale = 1;  // relative luminance per cd/m2
  bool camera_scale_free = true;
  double meter_scale = 1;
  bool meter_scale_free = false;   // wants a prior: nothing else tells it from the fluxes
  Eigen::VectorXd sensor_gain;     // by Reading::sensor; empty: 1
  bool sensor_gains_free = false;  // want priors likewise
};

// The free parameters in their order, with bounds: positions within the room's bounding box (a luminaire
// hangs inside), albedo 0.01..0.98, exponent 0.2..100, size 1 mm..half the room, tilt +-1 rad.
std::vector<Parameter> FreeParameters(const Room& room, const LightState& state);
// x = PackParameters(WithParameters(state, parameters, x), parameters) for every x within the bounds.
Eigen::VectorXd PackParameters(const LightState& state, const std::vector<Parameter>& parameters);
LightState WithParameters(LightState state, const std::vector<Parameter>& parameters,
                          const Eigen::VectorXd& x);

// The same parameters, tilts and headings counted from where the luminaires of `state` now point: they pack to 0 there, which is
// where Predict has their derivatives.
std::vector<Parameter> Recentred(std::vector<Parameter> parameters, const LightState& state);

// Whether the parameter is the share of a node of a table or of a cell.
bool IsPart(const Parameter& parameter);
// That share of the part which the others are counted by.
double ReferenceShare(const LightState& state, const Parameter& parameter);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_LIGHT_STATE_H_
