// Holds what a fit is made to: luminance of elements in photos, and readings of a luxmeter.
#ifndef LUXFIT_INVERSE_MODEL_LIGHT_DATA_H_
#define LUXFIT_INVERSE_MODEL_LIGHT_DATA_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/sensor.h"
#include "inverse/observe/observe.h"

namespace luxfit {

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

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_LIGHT_DATA_H_
