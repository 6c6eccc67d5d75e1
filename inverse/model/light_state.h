// Holds the data of a fit, and what the fit varies to explain them.
//
// LightData: luminance of elements in photos, readings of a luxmeter, outlines of luminaires in photos. LightState: luminaires,
// reflectances and scales, and which of their parameters are free.
//
// Free parameters are stacked in one vector. Fluxes, exponents and the scales of camera and meter are
// logarithms, which keeps them positive and makes scales additive. Positions and sizes are in metres. Tilts
// and headings are in radians from the parameter's frame.
#ifndef LUXFIT_INVERSE_MODEL_LIGHT_STATE_H_
#define LUXFIT_INVERSE_MODEL_LIGHT_STATE_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/light/room.h"
#include "inverse/model/parameter.h"
#include "inverse/observe/observe.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct Reading {
  Sensor sensor;
  int state = 0;
  double illuminance_lx = 0;
  double sigma_lx = 0;
  bool used = false;      // false: only predicted
  int sensor_index = -1;  // one of several sensors of a meter, each with its own gain; -1: the only sensor
  double ambient_lx = 0;  // already subtracted from illuminance_lx
};

// Ends a fit early, from LightData::checkpoint. what() says why.
class FitStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct LightData {
  std::vector<Eigen::VectorXd> dimming;  // one vector per state, by luminaire
  std::vector<Observation> observations;
  std::vector<Reading> readings;
  std::vector<LuminaireOutline> outlines;  // where the photos show luminaires themselves
  // Root L of the views' joint pose covariance L L^T, 6 rows for each view: rotation vector in world axes (rad),
  // camera centre in world (m). Empty: poses are exact.
  Eigen::MatrixXd pose_root;
  Eigen::Vector3d luminance_weights{0.265, 0.670, 0.065};  // of red, green and blue; they sum to 1
  // true: the observations carry their indirect light (inverse/model/internal/measured_indirect.h). No
  // radiosity is solved, and there are no readings.
  bool indirect_is_held = false;
  // Called before each round of a fit to these data, from any thread. It ends the fit by throwing FitStopped.
  // Empty: no calls.
  std::function<void(bool is_part)> checkpoint = {};
  bool is_part = false;  // what concerns a luminaire or a few, to compare models
};

// Says which quantities of one luminaire are free.
struct FreeQuantities {
  bool position = true;
  bool flux = true;
  bool exponent = false;
  bool size = false;
  bool tilt = false;
  bool heading = false;
  bool sides = false;  // how much of the flux goes up, of a table with two sides whose nodes are held
  // > 0: the shares of its table's nodes, or of its cells, are free; the value is the sigma of their
  // smoothness (inverse/model/internal/part_smoothness.h).
  double table_sigma = 0;
  double emission_sigma = 0;
  // true: of luminaires of one type, each has its own aim and heading, as spots have.
  bool own_direction = false;
};

// Says when the luminaires' bodies hide the surfaces behind them (forward/light/covered_surfaces.h).
enum class BodyPresence {
  kNone,
  kWhenOn,  // in states where the luminaire is on, as where each is hung up for its own photos
  kAlways,
};

// Reflectance of the bodies, from black to white, and its standard deviation.
constexpr double kBodyAlbedo = 0.5, kBodyAlbedoSigma = 0.3;

// The word of files: "none", "when_on" or "always".
std::string ToString(BodyPresence bodies);

// Bounds of a cosine power's exponent: nearly even over a half space, and a beam 6 degrees wide at half of its
// peak, narrower than spots for rooms are made.
constexpr double kLeastCosinePower = 0.2, kGreatestCosinePower = 500;

struct LightState {
  std::vector<Luminaire> luminaires;
  std::vector<FreeQuantities> free;  // one for each luminaire
  // Names, by luminaire, the first of its type. Luminaires of a type are alike but for place and flux: the first
  // one's parameters of distribution, size, emission and, without own_direction, of direction are those of all.
  // Empty: each its own type.
  std::vector<int> first_of_type = {};
  Eigen::VectorXd albedo;  // by material
  std::vector<bool> albedo_free;
  double camera_scale = 1;  // relative luminance per cd/m2
  bool camera_scale_free = true;
  double meter_scale = 1;
  bool meter_scale_free = false;   // needs a prior: nothing else tells it from the fluxes
  Eigen::VectorXd sensor_gain;     // by Reading::sensor; empty: 1
  bool sensor_gains_free = false;  // need priors likewise
  // By state: what is left in its photos of the ambient light, over what was subtracted (Observation::relative_ambient); below 0
  // where too much was subtracted. Empty: 0.
  Eigen::VectorXd ambient_share;
  bool ambient_shares_free = false;  // need priors likewise
  BodyPresence bodies = BodyPresence::kNone;
  // Albedo in red, green and blue over the albedo, by material; empty: the light between grey surfaces. Their
  // mean by LightData::luminance_weights is 1.
  Eigen::Matrix3Xd tint;
};

// Returns how far any point of a luminaire moved, in m; infinity where its shape changed.
double MoveOf(const Luminaire& from, const Luminaire& to);

class ChannelTransports;  // inverse/model/internal/channel_transports.h

// Holds what a fit ended with and what starts there need not compute again: the share of each luminaire that elements
// of a room see (elements x luminaires), for which luminaires and `order` (forward/light/room.h); and its channels.
struct FrozenLight {
  std::vector<Luminaire> luminaires;
  int order = 0;
  std::vector<int> which;  // elements, in the order of rows; empty: all of the room
  Eigen::MatrixXf elements;
  std::shared_ptr<const ChannelTransports> channels;  // null: all light is exchanged by plain grey surfaces
};

// Returns the luminaires' fluxes by state: luminaires x states, lm.
Eigen::MatrixXf LumensByState(const LightData& data, const std::vector<Luminaire>& luminaires);

bool IsFirstOfType(const LightState& state, int luminaire);

// Returns the luminaires of each type, in order; each for itself where there are no types.
std::vector<std::vector<int>> TypesOf(const LightState& state);

// Returns the luminaire as its type's first one is, with its own id, place and flux, and direction where it has one.
Luminaire OfTypeOf(const Luminaire& first, const Luminaire& luminaire, bool has_own_direction);

// Returns the state with every luminaire, and what is free of it, like the first of its type.
LightState WithLikeTypes(LightState state);

// Returns the free parameters in their order, with bounds: positions within the room's bounding box (a
// luminaire hangs inside), albedo 0.01..0.98, exponent kLeastCosinePower..kGreatestCosinePower, size 1 mm..half
// the room. A tilt is the tangent of the angle to the frame's aim, +-1: 45 degrees a step. Recentred moves the frame,
// so that a fit reaches any aim.
std::vector<Parameter> FreeParameters(const Room& room, const LightState& state);
// PackParameters reads the vector x of the parameters from a state; WithParameters writes it into one.
//   x = PackParameters(WithParameters(state, parameters, x), parameters) for every x within the bounds
Eigen::VectorXd PackParameters(const LightState& state, const std::vector<Parameter>& parameters);
LightState WithParameters(LightState state, const std::vector<Parameter>& parameters,
                          const Eigen::VectorXd& x);

// Returns the same parameters with tilts and headings counted from where the luminaires of `state` point.
// They pack to 0 there, and Predict has their derivatives at 0.
std::vector<Parameter> Recentred(std::vector<Parameter> parameters, const LightState& state);

// Returns whether the parameter is the share of a table's node or of a cell.
bool IsPart(const Parameter& parameter);
// Returns the share of the reference part, by which the other shares are divided.
double ReferenceShare(const LightState& state, const Parameter& parameter);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_LIGHT_STATE_H_
