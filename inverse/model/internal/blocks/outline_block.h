// Presents the outlines of luminaires in photos as rows of the fit.
//
//   0 = s d_i(theta)     px
//
// d_i: angle from the model's outline to ray i of the seen one (outline_distance.h), s: the photo's scale there.
// The points of one outline are not independent: what the contour does not follow (blur, halos, its threshold) moves
// several alike. Each therefore has a sigma of 1 px, which lets the 32 points of an outline tell its centre to a
// quarter of a pixel.
//
// Rows share errors, which the fit eliminates (inverse/model/internal/weights/row_weights.h): those of one view its pose, those of
// one camera the growth of its outlines, 0 +- kOutlineGrowthPx all round. A lens' blur, charge that runs over and pixels
// that a luminaire covers in part let it look larger. Its distance from several views tells its size from the growth.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_OUTLINE_BLOCK_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_OUTLINE_BLOCK_H_

#include <utility>
#include <vector>

#include "inverse/model/internal/blocks/row_block.h"

namespace luxfit {

constexpr double kOutlineSigmaPx = 1;
constexpr double kOutlineGrowthPx = 1;

class OutlineBlock : public RowBlock {
 public:
  // Keeps a reference. Throws std::invalid_argument for an outline of a luminaire that the data do not have.
  explicit OutlineBlock(const LightData& data);

  int row_count() const override { return static_cast<int>(rays_.size()); }
  RowReceiver ReceiverOf(int row) const override { return {-1, nullptr, Of(row).seen.state}; }
  double ValueOf(int /*row*/) const override { return 0; }
  double VarianceOf(int /*row*/) const override { return kOutlineSigmaPx * kOutlineSigmaPx; }
  bool IsUsed(int /*row*/) const override { return true; }
  bool IsRobust() const override { return true; }
  bool IsSpoiltByPenumbra() const override { return false; }
  RowResponse ResponseOf(const LightState& state, int row) const override;
  void AddOwnDerivatives(const LightState& state, const std::vector<Parameter>& parameters,
                         double illuminance_lx, int row,
                         Eigen::Ref<Eigen::RowVectorXd> derivatives) const override;
  std::optional<std::pair<int, int>> ClusterOf(int row) const override;
  Eigen::VectorXd BiasOf(const LightState& /*state*/) const override {
    return Eigen::VectorXd::Zero(row_count());
  }
  // Quantities of a view: its pose as in LightData::pose_root, and the growth of its camera's outlines (px).
  RowErrors SharedErrorsOf(const LightState& state, ViewErrors views) const override;

 private:
  Eigen::MatrixXd PoseDerivativeOf(const LightState& state) const;
  // Returns the root of the covariance of all views' quantities.
  Eigen::MatrixXd RootOfViews(ViewErrors views) const;
  const LuminaireOutline& Of(int row) const {
    return data_.outlines[static_cast<size_t>(rays_[static_cast<size_t>(row)].first)];
  }
  const OutlineRay& RayOf(int row) const {
    return Of(row).seen.rays[static_cast<size_t>(rays_[static_cast<size_t>(row)].second)];
  }

  const LightData& data_;
  std::vector<std::pair<int, int>> rays_;  // outline and its ray, for each row
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_BLOCKS_OUTLINE_BLOCK_H_
