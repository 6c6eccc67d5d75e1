// Presents the luminance of elements in photos as rows of the fit.
//
//   Y_es = rho_m(e) (c / pi E_es + I_es) + b_s A_e     relative luminance
//
// rho: albedo of the element's material, c: camera scale (relative luminance per cd/m2). I: indirect light
// that was measured (LightData::indirect_is_held), else 0. A: ambient light that was
// subtracted there, b: what is left of it in the photos of state s, over that. Rows of one facet in one state share their model
// error.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_PHOTO_BLOCK_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_PHOTO_BLOCK_H_

#include "inverse/model/internal/blocks/row_block.h"

namespace luxfit {

class PhotoBlock : public RowBlock {
 public:
  // Keeps references. Throws std::invalid_argument for an element that the room does not have.
  PhotoBlock(const Room& room, const LightData& data);

  int row_count() const override { return static_cast<int>(data_.observations.size()); }
  RowReceiver ReceiverOf(int row) const override { return {Of(row).element, nullptr, Of(row).state}; }
  double ValueOf(int row) const override { return Of(row).relative_luminance; }
  double VarianceOf(int row) const override { return Of(row).variance; }
  bool IsUsed(int /*row*/) const override { return true; }
  bool IsRobust() const override { return true; }
  bool IsSpoiltByPenumbra() const override { return true; }
  Eigen::Vector3d ChannelWeightsOf(const LightState& state, int row) const override {
    return data_.luminance_weights.cwiseProduct(state.tint.col(material_[static_cast<size_t>(row)]));
  }
  RowResponse ResponseOf(const LightState& state, int row) const override;
  void AddOwnDerivatives(const LightState& state, const std::vector<Parameter>& parameters,
                         double illuminance_lx, int row,
                         Eigen::Ref<Eigen::RowVectorXd> derivatives) const override;
  std::optional<std::pair<int, int>> ClusterOf(int row) const override;
  Eigen::VectorXd BiasOf(const LightState& state) const override;

 private:
  const Observation& Of(int row) const { return data_.observations[static_cast<size_t>(row)]; }
  const Patch& PatchOf(int row) const { return room_.patches.PatchOf(Of(row).element); }

  const Room& room_;
  const LightData& data_;
  std::vector<int> material_;  // one for each row
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_PHOTO_BLOCK_H_
