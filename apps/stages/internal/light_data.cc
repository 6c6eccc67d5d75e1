#include "apps/stages/internal/light_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace luxfit {
namespace {

// Relative standard uncertainty of a reading whose meter's class is not given: between DIN 5032-7 classes L
// and B.
constexpr double kUnknownMeterSigma = 0.02;
// Of a single reading of a meter whose class is given: placing it, and its display.
constexpr double kReadingSigma = 0.01;

// Sensors of one meter, each with a gain of its own that its readings share.
void AddSensorGains(double sigma, int sensors, SessionLight& light) {
  if (sensors == 0) return;
  light.sensor_gain = Eigen::VectorXd::Ones(sensors);
  light.sensor_gains_free = light.used_readings > 0;
  for (int i = 0; light.sensor_gains_free && i < sensors; ++i)
    light.priors.push_back({ParameterKind::kLogSensorGain, i, {}, 0, sigma});
}

}  // namespace

std::vector<Eigen::VectorXd> DimmingOf(const Session& session) {
  std::vector<Eigen::VectorXd> by_state;
  for (const SessionState& state : session.states) {
    Eigen::VectorXd dimming = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(session.luminaires.size()));
    for (size_t k = 0; k < session.luminaires.size(); ++k) {
      const auto on = state.dimming.find(session.luminaires[k].id);
      if (on != state.dimming.end()) dimming[static_cast<Eigen::Index>(k)] = on->second;
    }
    by_state.push_back(std::move(dimming));
  }
  return by_state;
}

std::vector<std::optional<double>> KnownAlbedo(const Session& session, const Room& room) {
  std::vector<std::optional<double>> known(room.scene.materials.size());
  for (size_t m = 0; session.scene && m < known.size(); ++m) {
    const auto given = session.scene->known_albedo_rgb.find(room.scene.materials[m]);
    if (given != session.scene->known_albedo_rgb.end())
      known[m] = LuminanceWeights(session).dot(given->second);
  }
  return known;
}

SessionLight LightOf(const Session& session, const std::vector<Observation>& observations) {
  SessionLight light;
  light.data.dimming = DimmingOf(session);
  light.data.observations = MergeViews(observations).observations;
  const SessionLuxmeter& meter = session.luxmeter;
  const bool has_fitted = std::any_of(meter.readings.begin(), meter.readings.end(),
                                      [](const SessionReading& r) { return r.role != ReadingRole::kCheck; });
  const bool has_class = meter.common_sigma > 0;
  // The calibration error is one and the same in all readings: a parameter where readings are fitted to, else
  // a part of each.
  light.meter_scale_free = has_class && has_fitted;
  if (light.meter_scale_free)
    light.priors.push_back({ParameterKind::kLogMeterScale, 0, {}, 0, meter.common_sigma});
  double relative = has_class ? kReadingSigma : kUnknownMeterSigma;
  if (has_class && !has_fitted) relative = std::hypot(kReadingSigma, meter.common_sigma);
  std::map<std::string, int> sensors;
  for (const SessionReading& given : meter.readings) {
    Reading reading;
    reading.sensor = {given.position_m, given.normal, meter.response};
    reading.state = std::max(0, StateIndex(session, given.state));
    reading.illuminance_lx = given.illuminance_lx;
    // Of the reading as it was taken, and of the one that was subtracted from it.
    const double taken_lx = std::hypot(given.illuminance_lx + given.ambient_lx, given.ambient_lx);
    reading.sigma_lx = relative * std::max(taken_lx, 1e-3);
    reading.used = given.role != ReadingRole::kCheck;
    reading.sensor_index = -1;
    if (!given.sensor.empty())
      reading.sensor_index = sensors.emplace(given.sensor, static_cast<int>(sensors.size())).first->second;
    light.used_readings += reading.used ? 1 : 0;
    light.data.readings.push_back(reading);
  }
  AddSensorGains(meter.sensor_sigma, static_cast<int>(sensors.size()), light);
  return light;
}

void RecordReadings(const Session& session, const SessionLight& light, RunContext& context) {
  if (light.sensor_gain.size() > 0) {
    context.choices.push_back({"gains of the meter's sensors",
                               fmt::format("{} gains, each 1 ± {:g} beforehand", light.sensor_gain.size(),
                                           session.luxmeter.sensor_sigma),
                               {},
                               "the readings' table has a column sensor"});
  }
  if (light.meter_scale_free) {
    context.choices.push_back({"uncertainty of a reading",
                               fmt::format("{:g} % of each, {:g} % common to all (1 sigma)",
                                           100 * kReadingSigma, 100 * session.luxmeter.common_sigma),
                               {"each by itself", "one common scale"},
                               "luxmeter.class is a calibration's: more readings do not lessen it"});
  } else if (!session.luxmeter.readings.empty() && session.luxmeter.common_sigma == 0) {
    context.choices.push_back({"uncertainty of a reading",
                               fmt::format("{:g} % (1 sigma)", 100 * kUnknownMeterSigma),
                               {},
                               "luxmeter.class is not given; class B (10 % expanded) would be 5 %, L 1.5 %"});
  }
}

}  // namespace luxfit
