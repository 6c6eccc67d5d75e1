#include "inverse/model/internal/intervals/parameter_shift.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "inverse/model/internal/frozen_problem.h"
#include "inverse/model/internal/intervals/fit_covariance.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"
#include "inverse/model/internal/weights/row_weights.h"

namespace luxfit {
namespace {

LightData WithObservations(const LightData& data, const std::vector<size_t>& rows) {
  LightData part;
  part.dimming = data.dimming;
  part.readings = data.readings;
  part.outlines = data.outlines;
  part.pose_root = data.pose_root;
  part.luminance_weights = data.luminance_weights;
  part.indirect_is_held = data.indirect_is_held;
  part.observations.reserve(rows.size());
  for (const size_t row : rows) part.observations.push_back(data.observations[row]);
  return part;
}

// Returns the part's entries of a vector over all rows.
Eigen::VectorXd Take(const Eigen::VectorXd& all, const std::vector<size_t>& rows, Eigen::Index photos) {
  const auto taken = static_cast<Eigen::Index>(rows.size());
  Eigen::VectorXd part(taken + all.size() - photos);
  for (Eigen::Index i = 0; i < taken; ++i)
    part[i] = all[static_cast<Eigen::Index>(rows[static_cast<size_t>(i)])];
  part.tail(all.size() - photos) = all.tail(all.size() - photos);
  return part;
}

// Returns the weights that the fit's last equations gave to the part's rows.
RowWeights WeightsOf(const Room& room, const LightData& part, const LightModel& model,
                     const LuminaireFit& fit, const std::vector<size_t>& rows, Eigen::Index photos,
                     const Eigen::VectorXd& value) {
  RowWeights weights;
  weights.root_weight = Take(fit.root_weight, rows, photos);
  weights.texture = {Take(fit.texture, rows, photos), Take(fit.texture_sigma, rows, photos),
                     fit.material_texture_sigma};
  const TextureEstimator elements(room, part);
  // The design effect divides what rows tell together. It does not change how they share errors.
  Eigen::VectorXd own = weights.root_weight;
  own.head(static_cast<Eigen::Index>(rows.size())) *= std::sqrt(fit.photo_design_effect);
  weights.whitening =
      WhiteningOf(model, fit.state, elements, value, own, weights.texture, ViewErrors::kJoint);
  const Eigen::VectorXd plain = own.array() / (1 + weights.texture.deviation.array());
  weights.means = elements.Means(value, plain, weights.texture);
  return weights;
}

// Returns how many used rows each used one of the part stands for.
double RowsForEach(const LuminaireFit& fit, const RowWeights& weights, Eigen::Index photos,
                   Eigen::Index taken) {
  const auto used = [](const auto& root_weight) {
    return static_cast<double>((root_weight.array() > 0).count());
  };
  const double in_part = used(weights.root_weight.head(taken));
  return in_part > 0 ? used(fit.root_weight.head(photos)) / in_part : 1;
}

Eigen::MatrixXd PriorInformation(const LuminaireFit& fit, const std::vector<ParameterPrior>& priors) {
  NormalEquations known(static_cast<Eigen::Index>(fit.parameters.size()));
  AddPriors(PriorsOf(fit.parameters, priors), SmoothnessRows(fit.state, fit.parameters),
            PackParameters(fit.state, fit.parameters), known);
  return known.matrix;
}

}  // namespace

Eigen::MatrixXd ParameterShift(const Room& room, const LightData& data, const LuminaireFit& fit,
                               const std::vector<ParameterPrior>& priors, const std::vector<size_t>& rows,
                               const Eigen::MatrixXd& lost) {
  const auto taken = static_cast<Eigen::Index>(rows.size());
  const Eigen::Index photos = FirstReadingRow(data);
  if (lost.rows() != taken || fit.root_weight.size() < photos ||
      (taken > 0 && rows.back() >= data.observations.size()))
    throw std::invalid_argument("ParameterShift: expected rows of the data, and light for each");
  if (fit.parameters.empty()) return Eigen::MatrixXd::Zero(0, lost.cols());
  const LightData part = WithObservations(data, rows);
  LightModel model(room, part);
  model.SetPatchFactor(fit.patch_factor);
  if (fit.frozen) model.TakeOver(*fit.frozen);
  model.RefreezeVisibility(fit.state);
  const Prediction at_fit = model.Predict(fit.state, fit.parameters, true);
  const RowWeights weights = WeightsOf(room, part, model, fit, rows, photos, at_fit.value);

  RowMajorMatrix errors = RowMajorMatrix::Zero(model.row_count(), lost.cols());
  errors.topRows(taken) = lost;
  errors = weights.Weighed(errors);
  RowMajorMatrix jacobian = weights.Weighed(at_fit.jacobian);
  // The rows of the texture's means, at the end, tell more of more elements as photos' rows do.
  const Eigen::Index means = jacobian.rows() - model.row_count();
  const double root = std::sqrt(RowsForEach(fit, weights, photos, taken));
  for (RowMajorMatrix* weighed : {&errors, &jacobian}) {
    weighed->topRows(taken) *= root;
    weighed->bottomRows(means) *= root;
  }
  return InverseOf(jacobian.transpose() * jacobian + PriorInformation(fit, priors)) *
         (jacobian.transpose() * errors);
}

Eigen::VectorXd ShiftByPart(const Room& room, const LightData& data, const LuminaireFit& fit,
                            const std::vector<ParameterPrior>& priors, const std::vector<bool>& is_in_part) {
  const Eigen::Index photos = FirstReadingRow(data);
  if (is_in_part.size() != data.observations.size() || fit.target.size() < photos)
    throw std::invalid_argument("ShiftByPart: expected one entry for each observation of the fit");
  double used = 0, used_in_part = 0;
  for (Eigen::Index i = 0; i < photos; ++i) {
    if (!(fit.root_weight[i] > 0)) continue;
    ++used;
    used_in_part += is_in_part[static_cast<size_t>(i)] ? 1 : 0;
  }
  if (used_in_part == 0 || used_in_part == used)
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(fit.parameters.size()));
  std::vector<size_t> rows(is_in_part.size());
  std::iota(rows.begin(), rows.end(), size_t{0});
  Eigen::VectorXd lost = (fit.predicted - fit.target).head(photos);
  for (size_t i = 0; i < rows.size(); ++i) {
    if (is_in_part[i]) lost[static_cast<Eigen::Index>(i)] *= 1 - used / used_in_part;
  }
  return ParameterShift(room, data, fit, priors, rows, lost);
}

LargestShift LargestShiftOf(const LuminaireFit& fit, const Eigen::VectorXd& shift) {
  LargestShift largest;
  for (Eigen::Index i = 0; i < shift.size(); ++i) {
    const double sigma = std::sqrt(fit.covariance(i, i));
    if (!(sigma > 0) || std::abs(shift[i]) / sigma <= largest.sigmas) continue;
    largest.sigmas = std::abs(shift[i]) / sigma;
    largest.parameter = fit.parameters[static_cast<size_t>(i)].id();
  }
  return largest;
}

}  // namespace luxfit
