#include "inverse/model/internal/blocks/photo_block.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "inverse/model/internal/discretisation_bias.h"

namespace luxfit {

PhotoBlock::PhotoBlock(const Room& room, const LightData& data) : room_(room), data_(data) {
  material_.reserve(data.observations.size());
  for (int row = 0; row < row_count(); ++row) {
    if (Of(row).element < 0 || Of(row).element >= static_cast<int>(room.patches.elements.size()))
      throw std::invalid_argument("LightModel: expected an element index below " +
                                  std::to_string(room.patches.elements.size()));
    material_.push_back(PatchOf(row).material);
  }
}

RowResponse PhotoBlock::ResponseOf(const LightState& state, int row) const {
  const double rho = state.albedo[material_[static_cast<size_t>(row)]];
  const double indirect = data_.indirect_is_held ? Of(row).relative_indirect : 0;
  const double ambient =
      state.ambient_share.size() > 0 ? state.ambient_share[Of(row).state] * Of(row).relative_ambient : 0;
  return {state.camera_scale / M_PI * rho, rho * indirect + ambient};
}

void PhotoBlock::AddOwnDerivatives(const LightState& state, const std::vector<Parameter>& parameters,
                                   double illuminance_lx, int row,
                                   Eigen::Ref<Eigen::RowVectorXd> derivatives) const {
  const int material = material_[static_cast<size_t>(row)];
  const double unit = state.camera_scale / M_PI;
  for (size_t p = 0; p < parameters.size(); ++p) {
    const Parameter& parameter = parameters[p];
    double& derivative = derivatives[static_cast<Eigen::Index>(p)];
    if (parameter.kind == ParameterKind::kLogCameraScale)
      derivative += unit * state.albedo[material] * illuminance_lx;
    else if (parameter.kind == ParameterKind::kAlbedo && parameter.index == material)
      derivative += unit * illuminance_lx + (data_.indirect_is_held ? Of(row).relative_indirect : 0);
    else if (parameter.kind == ParameterKind::kAmbientShare && parameter.index == Of(row).state)
      derivative += Of(row).relative_ambient;
  }
}

std::optional<std::pair<int, int>> PhotoBlock::ClusterOf(int row) const {
  return std::make_pair(PatchOf(row).facet, Of(row).state);
}

Eigen::VectorXd PhotoBlock::BiasOf(const LightState& state) const {
  return DiscretisationBias(room_, data_, state);
}

}  // namespace luxfit
