#include "forward/colour_illuminance.h"

#include <stdexcept>

namespace luxfit {

ColourIlluminance ComputeColourIlluminance(const Room& room, const Receivers& receivers,
                                           const LuminaireVisibility& visibility,
                                           const std::vector<Luminaire>& luminaires,
                                           const Eigen::Matrix3Xd& albedo_rgb,
                                           const Eigen::Vector3d& weights) {
  if (albedo_rgb.cols() != static_cast<Eigen::Index>(room.scene.materials.size()))
    throw std::invalid_argument("ComputeColourIlluminance: expected a reflectance for every material");
  if (!(weights.array() >= 0).all() || !(weights.sum() > 0))
    throw std::invalid_argument("ComputeColourIlluminance: expected weights >= 0, not all 0");
  ColourIlluminance result;
  const auto lamps = static_cast<Eigen::Index>(luminaires.size());
  result.total = Eigen::MatrixXf::Zero(receivers.count(), lamps);
  Eigen::Vector3d share = weights / weights.sum();
  for (int channel = 0; channel < 3; ++channel) {
    if (share[channel] == 0) continue;
    const Eigen::VectorXd albedo = albedo_rgb.row(channel).transpose();
    double weight = 0;
    for (int other = channel; other < 3; ++other) {
      if (albedo_rgb.row(other) != albedo_rgb.row(channel)) continue;
      weight += share[other];
      share[other] = 0;  // solved with this one
    }
    const Illuminance light = ComputeIlluminance(room, receivers, visibility, luminaires, albedo);
    result.total += static_cast<float>(weight) * light.total;
    result.direct = light.direct;
    ++result.solved_channels;
  }
  return result;
}

}  // namespace luxfit
