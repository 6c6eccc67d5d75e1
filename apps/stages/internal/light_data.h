// What a session's observations and readings say of light, as the inversion takes it.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_LIGHT_DATA_H_
#define LUXFIT_APPS_STAGES_INTERNAL_LIGHT_DATA_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

struct SessionLight {
  LightData data;                      // views of one element merged; dimming by session.luminaires
  std::vector<ParameterPrior> priors;  // of the meter's calibration and of its sensors' gains
  bool meter_scale_free = false;       // the calibration is one common scale
  Eigen::VectorXd sensor_gain;         // start, one a sensor named
  bool sensor_gains_free = false;
  int used_readings = 0;  // fitted to, or for the scale
};
// By material of the room's mesh: the luminance reflectance that the session gives.
std::vector<std::optional<double>> KnownAlbedo(const Session& session, const Room& room);

SessionLight LightOf(const Session& session, const std::vector<Observation>& observations);

// One a state, by session.luminaires.
std::vector<Eigen::VectorXd> DimmingOf(const Session& session);

// How sure a reading is taken to be, for `choices`.
void RecordReadings(const Session& session, const SessionLight& light, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_LIGHT_DATA_H_
