#include "inverse/model/internal/intervals/known_parameters.h"

#include <algorithm>

#include "forward/luminaire/distribution_ops.h"

namespace luxfit {
namespace {

// Returns whether the parameter changes light. The camera's and the meter's scales do not.
bool ChangesLight(ParameterKind kind) {
  return kind == ParameterKind::kLuminaire || kind == ParameterKind::kLogFlux ||
         kind == ParameterKind::kAlbedo;
}

}  // namespace

LightState AllFree(const Room& room, const std::vector<Luminaire>& luminaires,
                   const Eigen::VectorXd& albedo) {
  LightState state;
  state.luminaires = luminaires;
  for (const Luminaire& luminaire : luminaires) {
    FreeQuantities free;
    free.exponent = free.size = free.tilt = free.heading = true;
    free.table_sigma = OpsOf(luminaire.distribution).has_table ? 1 : 0;
    free.emission_sigma = luminaire.emission.size() > 0 ? 1 : 0;
    state.free.push_back(free);
  }
  state.albedo = albedo;
  state.albedo_free.assign(room.scene.materials.size(), true);
  state.camera_scale_free = false;
  return state;
}

KnownParameters FindKnown(const std::vector<Parameter>& possible, const ParameterCovariance& given) {
  KnownParameters known;
  std::vector<Eigen::Index> rows;
  for (size_t i = 0; i < given.parameters.size(); ++i) {
    const auto at = std::find_if(possible.begin(), possible.end(),
                                 [&](const Parameter& p) { return p.id() == given.parameters[i]; });
    if (at != possible.end()) {
      known.parameters.push_back(*at);
      rows.push_back(static_cast<Eigen::Index>(i));
    } else if (ChangesLight(given.parameters[i].kind)) {
      known.left_out.push_back(given.parameters[i]);
    }
  }
  known.covariance = given.covariance(rows, rows);
  return known;
}

}  // namespace luxfit
