#include "forward/light/scene_light.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace luxfit {

PatchesOptions PatchesOfSize(double patch_size_m) {
  PatchesOptions options;
  options.patch_size_m = patch_size_m;
  options.element_size_m = patch_size_m / 4;
  return options;
}

ColourIlluminance Relight(const LitScene& lit, const SceneLight& prediction,
                          const RadiositySolverOptions& solver) {
  return ComputeColourIlluminance(prediction.room, prediction.receivers, prediction.visibility,
                                  lit.luminaires, lit.albedo_rgb, lit.channel_weights, solver);
}

SceneLight ComputeSceneLight(const LitScene& lit, const SceneLightOptions& options) {
  Room room = MakeRoom(lit.scene, options.room);
  Receivers receivers = MakeReceivers(room, {}, lit.sensors, options.rays_per_sensor);
  LuminaireVisibility visibility = ComputeVisibility(room, receivers, lit.luminaires);
  SceneLight prediction{std::move(room), std::move(receivers), std::move(visibility), {}};
  prediction.light = Relight(lit, prediction, options.solver);
  return prediction;
}

SceneLight Regather(const LitScene& lit, SceneLight prediction, const SceneLightOptions& options) {
  prediction.receivers = MakeReceivers(prediction.room, {}, lit.sensors, options.rays_per_sensor);
  prediction.light = Relight(lit, prediction, options.solver);
  return prediction;
}

double RelativeRmsPercent(const Eigen::MatrixXd& value, const Eigen::MatrixXd& reference) {
  constexpr double kDark = 0.01;
  if (value.rows() != reference.rows() || value.cols() != reference.cols())
    throw std::invalid_argument("RelativeRmsPercent: expected matrices of one shape");
  if (value.size() == 0) return 0;
  double squares = 0;
  for (Eigen::Index c = 0; c < value.cols(); ++c) {
    const double least = kDark * reference.col(c).cwiseAbs().mean();
    for (Eigen::Index r = 0; r < value.rows(); ++r) {
      const double scale = std::max(std::abs(reference(r, c)), least);
      if (scale > 0) squares += std::pow((value(r, c) - reference(r, c)) / scale, 2);
    }
  }
  return 100 * std::sqrt(squares / static_cast<double>(value.size()));
}

}  // namespace luxfit
