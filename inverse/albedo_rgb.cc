#include "inverse/albedo_rgb.h"

#include <algorithm>
#include <limits>

namespace luxfit {
namespace {

// Reflectances are one number a material: a few thousand observations fix them as well as all would.
constexpr size_t kMaxObservations = 6000;

LightData ChannelData(const LightData& data, Eigen::Index channel) {
  LightData thin;
  thin.dimming = data.dimming;
  const size_t stride = std::max<size_t>(1, data.observations.size() / kMaxObservations);
  for (size_t i = 0; i < data.observations.size(); i += stride) {
    Observation o = data.observations[i];
    const double ratio = o.relative_rgb[channel] / o.relative_luminance;
    if (!(ratio > 0)) continue;
    o.relative_luminance *= ratio;
    o.variance *= ratio * ratio;
    thin.observations.push_back(o);
  }
  return thin;
}

}  // namespace

Eigen::Matrix3Xd EstimateAlbedoRgb(const Room& room, const LightData& data, const LuminaireFit& fit) {
  Eigen::Matrix3Xd rgb =
      Eigen::Matrix3Xd::Constant(3, fit.state.albedo.size(), std::numeric_limits<double>::quiet_NaN());
  LightState start = fit.state;
  start.camera_scale_free = false;
  start.meter_scale_free = false;
  for (FreeQuantities& free : start.free) free = {false, false, false, false, false};
  FitLuminairesOptions options;
  options.covariance = false;
  options.max_outer_iterations = 2;  // nothing moves: the second only settles the weights
  for (Eigen::Index c = 0; c < 3; ++c) {
    const LuminaireFit channel = FitLuminaires(room, ChannelData(data, c), start, {}, options);
    if (channel.status == FitStatus::kNoData) continue;
    for (Eigen::Index m = 0; m < rgb.cols(); ++m) {
      if (start.albedo_free[static_cast<size_t>(m)]) rgb(c, m) = channel.state.albedo[m];
    }
  }
  return rgb;
}

}  // namespace luxfit
