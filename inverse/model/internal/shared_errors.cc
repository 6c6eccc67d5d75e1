#include "inverse/model/internal/shared_errors.h"

namespace luxfit {

Eigen::VectorXd DiscretisationBias(const LightModel& model, const LightState& state) {
  Eigen::VectorXd bias(model.row_count());
  Eigen::Index first = 0;
  for (const auto& block : model.blocks()) {
    const Eigen::Index count = block->row_count();
    if (count > 0) bias.segment(first, count) = block->BiasOf(state);
    first += count;
  }
  return bias;
}

Eigen::MatrixXd SharedErrors(const LightModel& model, const LightState& state, const Prediction& at_state,
                             const Eigen::VectorXd& subtracted_bias) {
  // The bias is extrapolated from two sizes; a third of it may be left.
  constexpr double kBiasLeft = 1.0 / 3;
  Eigen::MatrixXd errors(model.row_count(), at_state.d_body.size() > 0 ? 3 : 2);
  errors.col(0) = kBiasLeft * subtracted_bias;
  if (errors.cols() > 2) errors.col(2) = kBodyAlbedoSigma * at_state.d_body;
  Eigen::Index first = 0;
  for (const auto& block : model.blocks()) {
    const Eigen::Index count = block->row_count();
    if (count == 0) continue;
    errors.col(1).segment(first, count) = block->SharedErrorOf(state);
    first += count;
  }
  return errors;
}

}  // namespace luxfit
