#include "apps/python/patch_light.h"

#include <numeric>

#include "forward/light/illuminance.h"
#include "forward/radiosity/transport.h"

namespace luxfit {

PatchLight ComputePatchLight(const Room& room, const std::vector<Luminaire>& luminaires,
                             const Eigen::Matrix3Xd& albedo_rgb, const Eigen::Vector3d& weights) {
  std::vector<int> elements(room.patches.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  const Receivers receivers = MakeReceivers(room, elements, {});
  const LuminaireVisibility visibility = ComputeVisibility(room, receivers, luminaires);
  const auto patches = static_cast<Eigen::Index>(room.patches.patches.size());
  const auto count = static_cast<Eigen::Index>(luminaires.size());
  PatchLight light{Eigen::MatrixXd::Zero(patches, count), Eigen::MatrixXd::Zero(patches, count)};
  Eigen::MatrixXd channel_lx;
  Eigen::Index solved = -1;  // the channel of this solution
  for (Eigen::Index c = 0; c < 3; ++c) {
    if (weights[c] == 0) continue;
    if (solved < 0 || albedo_rgb.row(c) != albedo_rgb.row(solved)) {
      solved = c;
      const Eigen::Vector3d channel = Eigen::Vector3d::Unit(c);
      channel_lx =
          PatchMean(
              room.patches,
              ComputeColourIlluminance(room, receivers, visibility, luminaires, albedo_rgb, channel).total)
              .cast<double>();
    }
    const double share = weights[c] / weights.sum();
    light.illuminance_lx += share * channel_lx;
    for (Eigen::Index j = 0; j < patches; ++j)
      light.exitance_lm_m2.row(j) +=
          share * albedo_rgb(c, room.patches.patches[static_cast<size_t>(j)].material) * channel_lx.row(j);
  }
  const Eigen::VectorXd flux_lm = FluxesLm(luminaires);
  return {light.illuminance_lx * flux_lm.asDiagonal(), light.exitance_lm_m2 * flux_lm.asDiagonal()};
}

}  // namespace luxfit
