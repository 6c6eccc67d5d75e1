#include "inverse/observe/as_if/internal/srgb_observations.h"

#include <cmath>

#include "calib/luminance/response.h"

namespace luxfit {
namespace {

constexpr double kFullScale = 65535;

// Returns ln of decoded light over light, as seen by the weights of luminance.
double LogDecoded(const CameraResponse& srgb, const Eigen::Vector3d& share) {
  const Eigen::Vector3d weights = LuminanceOptions().weights;
  Eigen::Vector3d decoded;
  for (Eigen::Index c = 0; c < 3; ++c)
    decoded[c] = srgb.Exposure(static_cast<size_t>(c), kFullScale * share[c]);
  return std::log(weights.dot(decoded) / weights.dot(share));
}

}  // namespace

std::vector<Observation> DecodedSrgb(std::vector<Observation> observations, const CountedShares& shares) {
  constexpr double kStep = 0.01;  // of ln light, for the curve's slope
  const CameraResponse srgb = SrgbResponse(kFullScale);
  for (Observation& o : observations) {
    const auto counted = shares.find({o.view, o.state});
    if (counted == shares.end()) continue;
    const Eigen::Vector3d share = counted->second * o.relative_rgb;
    const double log_decoded = LogDecoded(srgb, share);
    if (!std::isfinite(log_decoded)) continue;
    const double slope = 1 + (LogDecoded(srgb, std::exp(kStep) * share) - log_decoded) / kStep;
    const double factor = std::exp(log_decoded);
    o.relative_luminance *= factor;
    o.variance *= factor * factor * slope * slope;
  }
  return observations;
}

}  // namespace luxfit
