// Presents the readings of a luxmeter as rows of the fit.
//
//   R_rs = g h_i E_rs     lx
//
// g: the meter's calibration, common to all its readings. h_i: the gain of its sensor i, where it has
// several. Readings stand alone: each was taken on purpose, and its stated sigma counts.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_READING_BLOCK_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_READING_BLOCK_H_

#include "inverse/model/internal/blocks/row_block.h"

namespace luxfit {

class ReadingBlock : public RowBlock {
 public:
  // Keeps a reference.
  explicit ReadingBlock(const LightData& data) : data_(data) {}

  int row_count() const override { return static_cast<int>(data_.readings.size()); }
  RowReceiver ReceiverOf(int row) const override { return {-1, &Of(row).sensor, Of(row).state}; }
  double ValueOf(int row) const override { return Of(row).illuminance_lx; }
  double VarianceOf(int row) const override { return Of(row).sigma_lx * Of(row).sigma_lx; }
  bool IsUsed(int row) const override { return Of(row).used; }
  bool IsRobust() const override { return false; }
  bool IsSpoiltByPenumbra() const override { return false; }
  Eigen::Vector3d ChannelWeightsOf(const LightState& /*state*/, int /*row*/) const override {
    return data_.luminance_weights;
  }
  RowResponse ResponseOf(const LightState& state, int row) const override;
  void AddOwnDerivatives(const LightState& state, const std::vector<Parameter>& parameters,
                         double illuminance_lx, int row,
                         Eigen::Ref<Eigen::RowVectorXd> derivatives) const override;
  std::optional<std::pair<int, int>> ClusterOf(int /*row*/) const override { return std::nullopt; }
  Eigen::VectorXd BiasOf(const LightState& /*state*/) const override {
    return Eigen::VectorXd::Zero(row_count());
  }

 private:
  const Reading& Of(int row) const { return data_.readings[static_cast<size_t>(row)]; }

  const LightData& data_;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_READING_BLOCK_H_
