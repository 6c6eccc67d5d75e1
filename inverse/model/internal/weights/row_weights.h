// Weighs the rows of a fit: model error, texture of elements, robust weights, and errors that rows share.
//
//   sigma_i^2 = s_i^2 + (f data_i)^2,   w_i = 1 / (1 + (z_i / k)^2),   u_i = sqrt(w_i) / sigma_i
//   fitted:  W u (model(theta) - target), and the rows of TextureMean
//
// W whitens what rows share (inverse/model/internal/weights/row_whitening.h): the texture of an element in all states
// (element_texture.h), and the errors of a block (row_block.h). z_i is what remains of the residual by the
// best texture and shared errors, over its own sigma. f is the relative error that the remainders of the first block
// with rows show: their median |z| is a Gaussian's.
//
// An element of reflectance rho (1 + t) changes by (1 + t) with the light. Its rows therefore have the root
// weight (1 + t) u and the target model - (model - data) / (1 + t), all at the state where the weights were
// found.
//
// Where photos' rows know less than their number says, `photo_design_effect` divides their information.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ROW_WEIGHTS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ROW_WEIGHTS_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/model/internal/intervals/cluster_sums.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/weights/element_texture.h"
#include "inverse/model/internal/weights/row_whitening.h"

namespace luxfit {

struct RowWeights {
  Eigen::VectorXd target;
  Eigen::VectorXd weight;       // robust; 0: left out
  Eigen::VectorXd root_weight;  // of the equations; 0: left out
  ElementTexture texture;
  RowWhitening whitening;
  std::vector<TextureMean> means;  // rows that follow those of the model

  RowMajorMatrix Weighed(const RowMajorMatrix& jacobian) const;
  Eigen::VectorXd Weighed(const Eigen::VectorXd& errors) const;
  Eigen::VectorXd Residual(const Eigen::VectorXd& value) const {
    return Weighed(Eigen::VectorXd(value - target));
  }
  // Returns the rows of `means` with their residuals parted by cluster. `cluster`: of each row of the model. What a
  // facet's rows err alike does not average out over its elements.
  std::vector<SpreadRow> MeansByCluster(const Eigen::VectorXd& value, const std::vector<int>& cluster) const;
};

// Returns the whitening for given weights. `value`: the model's; `root_weight` and `texture` as in
// RowWeights.
RowWhitening WhiteningOf(const LightModel& model, const LightState& state, const TextureEstimator& elements,
                         const Eigen::VectorXd& value, const Eigen::VectorXd& root_weight,
                         const ElementTexture& texture, ViewErrors views);

struct RowWeigherOptions {
  double robust_sigmas = 3;
  double min_relative_sigma = 2e-3;
  bool has_texture = true;
};

// Holds what the blocks say of their rows, and weighs them at a state.
class RowWeigher {
 public:
  // Keeps references.
  RowWeigher(const Room& room, const LightData& data, const LightModel& model,
             const RowWeigherOptions& options);

  // Returns the weights where the model predicts `value`. Updates f. `last`: the weights of the state before;
  // their robust weights and texture are where this one starts. Empty: none.
  RowWeights Weigh(const LightState& state, const Eigen::VectorXd& value, const std::vector<bool>& left_out,
                   double photo_design_effect, const RowWeights& last, double& relative_sigma) const;

  const TextureEstimator& elements() const { return elements_; }
  const std::vector<bool>& is_used() const { return is_used_; }
  bool HasData() const;

 private:
  double SigmaOf(Eigen::Index row, double relative_sigma) const;
  // Returns the factor by which f is too small.
  double ModelErrorRatio(const Eigen::VectorXd& z, const Eigen::VectorXd& root_weight) const;

  const LightModel& model_;
  const RowWeigherOptions options_;
  const TextureEstimator elements_;
  Eigen::Index photo_rows_ = 0;
  Eigen::Index materials_ = 0;
  Eigen::VectorXd values_, variance_;
  std::vector<bool> is_used_, is_robust_;
  std::vector<bool> carries_model_error_;  // rows of the first block that has any
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_ROW_WEIGHTS_H_
