// The model that the fit inverts: parameters -> what photos and luxmeters should read, with its Jacobian.
//
//   photo:  Y_es = c rho_m(e) / pi * sum_k d_sk Phi_k E_ek(theta)   relative luminance of element e, state s
//   meter:  E_rs = g h_i sum_k d_sk Phi_k E_rk(theta)               lx
//
// d: dimming, Phi: flux, E: illuminance per lumen (forward/light/illuminance.h), rho: albedo, c: camera scale,
// relative luminance per cd/m2, g: the meter's calibration, common to all its readings, h_i: the gain of its
// sensor i, where it has several. Free parameters are
// stacked in one vector; fluxes, exponents and the scales of camera and meter as logarithms, so that they
// stay positive and scales separate; positions and sizes in metres; tilts in radians about the start's aim.
//
// Where the indirect light was measured (LightData::indirect_is_held), E is direct alone and a photo's
// row
//   Y_es = rho_m(e) (I_es + c / pi * sum_k d_sk Phi_k D_ek(theta)).
//
// Rows: observations in their order, then readings. Jacobian rows x parameters, exact for frozen visibility.
// Throws std::invalid_argument for indices out of range, and for readings beside measured indirect light.
#ifndef LUXFIT_INVERSE_MODEL_LIGHT_MODEL_H_
#define LUXFIT_INVERSE_MODEL_LIGHT_MODEL_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "inverse/model/parameter.h"
#include "inverse/observe/observe.h"

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

struct Reading {
  Sensor sensor;
  int state = 0;
  double illuminance_lx = 0;
  double sigma_lx = 0;
  bool used = false;      // false: only predicted
  int sensor_index = -1;  // of several of one meter, each with a gain of its own; -1: the meter's only one
};

struct LightData {
  std::vector<Eigen::VectorXd> dimming;  // one a state, by luminaire
  std::vector<Observation> observations;
  std::vector<Reading> readings;
  // Indirect light is the observations' own (inverse/model/measured_indirect.h): no radiosity is solved, and there
  // are no readings.
  bool indirect_is_held = false;
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

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Prediction {
  Eigen::VectorXd value;
  RowMajorMatrix jacobian;            // empty if not asked for
  Eigen::VectorXd reading_direct_lx;  // direct part of each reading
};

class LightModel {
 public:
  // Keeps references: `room` and `data` must outlive it. Not to be shared by threads.
  LightModel(const Room& room, const LightData& data);

  // Sets the visible shares that Predict uses, for the luminaires where they now are (ComputeVisibility's
  // order).
  void FreezeVisibility(const LightState& state, int order = 3);
  // Rows of the observations that a shadow edge crosses: a luminaire dimmed to more than `min_dimming` is
  // seen in part.
  std::vector<bool> InPenumbra(double min_dimming = 0.02) const;
  Prediction Predict(const LightState& state, const std::vector<Parameter>& parameters,
                     bool with_jacobian) const;

  int row_count() const { return static_cast<int>(receiver_of_row_.size()); }

 private:
  // Per lumen, at the receivers.
  Illuminance Light(const LightState& state, const DerivativeRequest& request) const;

  const Room& room_;
  const LightData& data_;
  Receivers receivers_;
  std::vector<int> receiver_of_row_;
  std::vector<int> state_of_row_;
  std::vector<int> material_of_row_;  // -1 for readings
  LuminaireVisibility visibility_;
  // Of the reflectances asked for last: most steps of a fit that holds them do without another factorisation.
  mutable std::optional<Transport> transport_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_LIGHT_MODEL_H_
