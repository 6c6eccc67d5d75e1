#include "inverse/fit/internal/room_light.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "inverse/fit/internal/light_colours.h"
#include "inverse/observe/ambient_light.h"

namespace luxfit {
namespace {

constexpr double kOutlierSigmas = 4;

// Returns L with L L^T = C.
Eigen::MatrixXd RootOf(const Eigen::MatrixXd& covariance) {
  if (covariance.size() == 0) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

// Relative standard uncertainty of a reading whose meter class is not given. It lies between DIN 5032-7
// classes L and B.
constexpr double kUnknownMeterSigma = 0.02;
// Relative sigma of one reading of a meter whose class is given: its placement and display.
constexpr double kReadingSigma = 0.01;

// Gives each sensor of the meter a gain that its readings share.
void AddSensorGains(double sigma, int sensors, RoomLight& light) {
  if (sensors == 0) return;
  light.sensor_gain = Eigen::VectorXd::Ones(sensors);
  light.sensor_gains_free = light.used_readings > 0;
  for (int i = 0; light.sensor_gains_free && i < sensors; ++i)
    light.priors.push_back({ParameterKind::kLogSensorGain, i, {}, 0, sigma});
}

// Gives each state a share of ambient light that is left or missing in all of its photos.
void AddAmbientShares(RoomLight& light) {
  const auto& observations = light.data.observations;
  const bool has_ambient = std::any_of(observations.begin(), observations.end(),
                                       [](const Observation& o) { return o.relative_ambient > 0; });
  if (!has_ambient) return;
  const auto states = static_cast<int>(light.data.dimming.size());
  light.ambient_share = Eigen::VectorXd::Zero(states);
  for (int s = 0; s < states; ++s)
    light.priors.push_back({ParameterKind::kAmbientShare, s, {}, 0, kShareSigma});
}

}  // namespace

double RelativeReadingSigma(double common_sigma, bool scale_is_free) {
  if (!(common_sigma > 0)) return kUnknownMeterSigma;
  return scale_is_free ? kReadingSigma : std::hypot(kReadingSigma, common_sigma);
}

RoomLight LightOf(const Room& room, const RoomObservations& given) {
  RoomLight light;
  light.data.dimming = given.dimming;
  light.data.luminance_weights = given.luminance_weights;
  light.labels = LabelSurfaces(room, given.observations);
  MergedObservations merged =
      MergeViews(OfOwnSurface(given.observations, light.labels), {{}, kOutlierSigmas, kLeastBetweenViews});
  light.data.observations = std::move(merged.observations);
  light.between_views = merged.between_views;
  light.balance = ChannelBalance(room, given);
  light.data = WithBalance(std::move(light.data), light.balance);
  light.data.pose_root = RootOf(given.pose_covariance);
  const Meter& meter = given.meter;
  const bool has_fitted =
      std::any_of(meter.readings.begin(), meter.readings.end(), [](const MeterReading& r) { return r.used; });
  const bool has_class = meter.common_sigma > 0;
  // All readings share one calibration error: a parameter where the fit uses readings, else a part of each
  // sigma.
  light.meter_scale_free = has_class && has_fitted;
  if (light.meter_scale_free)
    light.priors.push_back({ParameterKind::kLogMeterScale, 0, {}, 0, meter.common_sigma});
  const double relative = RelativeReadingSigma(meter.common_sigma, light.meter_scale_free);
  for (const MeterReading& taken : meter.readings) {
    Reading reading;
    reading.sensor = taken.sensor;
    reading.state = taken.state;
    reading.illuminance_lx = taken.illuminance_lx;
    // The sigma covers the reading as it was taken and the ambient reading that was subtracted.
    const double taken_lx = std::hypot(taken.illuminance_lx + taken.ambient_lx, taken.ambient_lx);
    reading.sigma_lx =
        std::hypot(relative * std::max(taken_lx, 1e-3), given.ambient_spread * taken.ambient_lx);
    reading.ambient_lx = taken.ambient_lx;
    reading.used = taken.used;
    reading.sensor_index = taken.sensor_index;
    light.used_readings += reading.used ? 1 : 0;
    light.data.readings.push_back(reading);
  }
  AddSensorGains(meter.sensor_sigma, meter.sensor_count, light);
  AddAmbientShares(light);
  return light;
}

void RecordBetweenViews(const RoomLight& light, Findings& findings) {
  if (light.data.observations.empty()) return;
  const BetweenViews& views = light.between_views;
  const double percent = 100 * views.relative_sigma;
  if (views.is_estimated) {
    findings.choices.push_back(
        {"disagreement of views",
         fmt::format("{:.2g} % beyond noise (1 sigma of each view)", percent),
         {},
         fmt::format("several views show the same element in the same state, {} times", views.groups)});
  } else {
    findings.choices.push_back(
        {"disagreement of views",
         fmt::format("{:.2g} % beyond noise (1 sigma of each view), assumed", percent),
         {},
         fmt::format("several views show the same element in the same state only {} times", views.groups)});
  }
}

void RecordReadings(const Meter& meter, const RoomLight& light, Findings& findings) {
  if (light.sensor_gain.size() > 0) {
    findings.choices.push_back(
        {"gains of the meter's sensors",
         fmt::format("{} gains, each with prior 1 ± {:g}", light.sensor_gain.size(), meter.sensor_sigma),
         {},
         "the readings' table has a column sensor"});
  }
  if (light.meter_scale_free) {
    findings.choices.push_back({"uncertainty of a reading",
                                fmt::format("{:g} % of each, {:g} % common to all (1 sigma)",
                                            100 * kReadingSigma, 100 * meter.common_sigma),
                                {"each by itself", "one common scale"},
                                "luxmeter.class is a calibration's: more readings do not lessen it"});
  } else if (!meter.readings.empty() && meter.common_sigma == 0) {
    findings.choices.push_back(
        {"uncertainty of a reading",
         fmt::format("{:g} % (1 sigma)", 100 * kUnknownMeterSigma),
         {},
         "luxmeter.class is not given; class B (10 % expanded) would be 5 %, L 1.5 %"});
  }
}

}  // namespace luxfit
