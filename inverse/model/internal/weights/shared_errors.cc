#include "inverse/model/internal/weights/shared_errors.h"

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

Eigen::MatrixXd SharedErrors(const Prediction& at_state, const Eigen::VectorXd& subtracted_bias) {
  // The bias is extrapolated from two sizes; a third of it may be left.
  constexpr double kBiasLeft = 1.0 / 3;
  Eigen::MatrixXd errors(subtracted_bias.size(), at_state.d_body.size() > 0 ? 2 : 1);
  errors.col(0) = kBiasLeft * subtracted_bias;
  if (errors.cols() > 1) errors.col(1) = kBodyAlbedoSigma * at_state.d_body;
  return errors;
}

}  // namespace luxfit
