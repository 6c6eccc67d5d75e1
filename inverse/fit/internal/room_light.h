// Turns what was observed in a room into the data of the light model: rows, their sigmas, priors of the meter.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_ROOM_LIGHT_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_ROOM_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/fit/findings.h"
#include "inverse/fit/room_observations.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct RoomLight {
  LightData data;                      // views of one element merged
  std::vector<ParameterPrior> priors;  // of the meter's calibration and of its sensors' gains
  bool meter_scale_free = false;       // the calibration is one common scale
  Eigen::VectorXd sensor_gain;         // start, one a sensor named
  bool sensor_gains_free = false;
  int used_readings = 0;  // fitted to, or for the scale
};

RoomLight LightOf(const RoomObservations& given);

// How sure a reading is taken to be, for `choices`.
void RecordReadings(const Meter& meter, const RoomLight& light, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_ROOM_LIGHT_H_
