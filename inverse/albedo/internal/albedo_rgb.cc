#include "inverse/albedo/internal/albedo_rgb.h"

#include <algorithm>
#include <limits>

#include "inverse/model/internal/measured_indirect.h"

namespace luxfit {
namespace {

// Each material has one reflectance: a thousand elements determine it as well as all would.
constexpr int kMaxRgbElements = 1000;

LightData ChannelData(const LightData& data, Eigen::Index channel) {
  LightData of_channel;
  of_channel.dimming = data.dimming;
  for (Observation o : data.observations) {
    const double ratio = o.relative_rgb[channel] / o.relative_luminance;
    if (!(ratio > 0)) continue;
    o.relative_luminance *= ratio;
    o.relative_ambient *= ratio;
    o.variance *= ratio * ratio;
    of_channel.observations.push_back(o);
  }
  return of_channel;
}

// Returns the albedo of every material, with the indirect light measured in the same data; empty without
// data.
Eigen::VectorXd AlbedoIn(const Room& room, const LightData& data, const LightState& light) {
  LightData measured = WithMeasuredIndirect(room, data);
  measured.observations = ThinElements(measured.observations, kMaxRgbElements);
  FitLuminairesOptions options;
  options.covariance = false;
  options.max_outer_iterations = 2;  // nothing moves: the second iteration only settles the weights
  const LuminaireFit fit = FitLuminaires(room, measured, light, {}, options);
  return fit.status == FitStatus::kNoData ? Eigen::VectorXd() : fit.state.albedo;
}

}  // namespace

Eigen::Matrix3Xd EstimateAlbedoRgb(const Room& room, const LightData& data, const LuminaireFit& fit) {
  Eigen::Matrix3Xd rgb =
      Eigen::Matrix3Xd::Constant(3, fit.state.albedo.size(), std::numeric_limits<double>::quiet_NaN());
  LightState light = fit.state;
  light.camera_scale_free = false;
  light.meter_scale_free = false;
  light.ambient_shares_free = false;
  for (FreeQuantities& free : light.free) free = {false, false, false, false, false};
  const Eigen::VectorXd of_luminance = AlbedoIn(room, data, light);
  if (of_luminance.size() == 0) return rgb;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::VectorXd of_channel = AlbedoIn(room, ChannelData(data, c), light);
    if (of_channel.size() == 0) continue;
    for (Eigen::Index m = 0; m < rgb.cols(); ++m) {
      if (light.albedo_free[static_cast<size_t>(m)])
        rgb(c, m) = fit.state.albedo[m] * of_channel[m] / of_luminance[m];
    }
  }
  return rgb;
}

}  // namespace luxfit
