#include "inverse/choose/internal/held_luminaires.h"

#include <algorithm>
#include <utility>

#include "inverse/model/internal/light_model.h"

namespace luxfit {

std::vector<Observation> WithHeldLight(const Room& room, const std::vector<Eigen::VectorXd>& dimming,
                                       const LightState& state, const std::vector<int>& members,
                                       std::vector<Observation> observations) {
  std::vector<int> held;
  for (int k = 0; k < static_cast<int>(state.luminaires.size()); ++k)
    if (std::find(members.begin(), members.end(), k) == members.end()) held.push_back(k);
  if (held.empty()) return observations;
  LightData of_held;
  for (const Eigen::VectorXd& of_all : dimming) of_held.dimming.emplace_back(of_all(held));
  of_held.observations = std::move(observations);
  of_held.indirect_is_held = true;
  LightState white;
  for (const int k : held) white.luminaires.push_back(state.luminaires[static_cast<size_t>(k)]);
  white.albedo = Eigen::VectorXd::Ones(state.albedo.size());
  white.camera_scale = state.camera_scale;
  LightModel model(room, of_held);
  model.FreezeVisibility(white);
  const std::vector<bool> penumbra = model.InPenumbra();
  const Eigen::VectorXd value = model.Predict(white, {}, false).value;
  std::vector<Observation> lit;
  for (size_t i = 0; i < penumbra.size(); ++i) {
    if (penumbra[i]) continue;
    lit.push_back(of_held.observations[i]);
    lit.back().relative_indirect = value[static_cast<Eigen::Index>(i)];
  }
  return lit;
}

}  // namespace luxfit
