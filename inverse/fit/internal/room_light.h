// Turns the observations of a room into data of the light model: rows, their sigmas and the meter's priors.
//
// Views of one element that show the element are merged (inverse/observe/surface_labels.h, observe.h). Where the meter's class is given, its calibration is
// one scale with a prior, shared by all readings. Units: lx, relative luminance.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_ROOM_LIGHT_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_ROOM_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/fit/fit_room.h"
#include "inverse/fit/room_observations.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/surface_labels.h"

namespace luxfit {

struct RoomLight {
  LightData data;                      // views of one element merged
  BetweenViews between_views;          // error of each view that they were merged with
  Eigen::Vector3d balance;             // of the data's channels (light_colours.h)
  SurfaceLabels labels;                // which views show something else
  std::vector<ParameterPrior> priors;  // of the meter, its sensors and ambient light
  bool meter_scale_free = false;       // true: the calibration is one common scale factor
  Eigen::VectorXd sensor_gain;         // starting values, one for each named sensor
  bool sensor_gains_free = false;
  Eigen::VectorXd ambient_share;  // starting values, one for each state; empty: there is no ambient light
  int used_readings = 0;          // for the fit or the scale
};

// Returns the relative sigma of one reading. `common_sigma`: of the meter's calibration, 0 where its class is not given.
// `scale_is_free`: the calibration is a parameter, and no part of the sigma.
double RelativeReadingSigma(double common_sigma, bool scale_is_free);

RoomLight LightOf(const Room& room, const RoomObservations& given);

// Records in `choices` how much views of one element disagree beyond noise.
void RecordBetweenViews(const RoomLight& light, Findings& findings);

// Records in `choices` the sigma that readings are given.
void RecordReadings(const Meter& meter, const RoomLight& light, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_ROOM_LIGHT_H_
