#include "inverse/model/internal/weights/row_weights.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/select/internal/robust_weight.h"

namespace luxfit {
namespace {

constexpr double kMedianOfAbsZ = 0.6745;  // of a Gaussian

void AddTexture(const TextureEstimator& elements, const Eigen::VectorXd& value,
                const Eigen::VectorXd& root_weight, const ElementTexture& texture, RowWhitening& whitening) {
  std::vector<double> effect;
  for (const std::vector<Eigen::Index>& rows : elements.rows_of_element()) {
    if (!(texture.sigma[rows.front()] > 0)) continue;
    effect.clear();
    for (const Eigen::Index i : rows)
      effect.push_back(texture.sigma[i] * value[i] * root_weight[i] / (1 + texture.deviation[i]));
    whitening.Add(rows, effect);
  }
}

void AddSharedErrors(const LightModel& model, const LightState& state, const Eigen::VectorXd& root_weight,
                     ViewErrors views, RowWhitening& whitening) {
  Eigen::Index first = 0;
  for (const auto& block : model.blocks()) {
    const Eigen::Index count = block->row_count();
    const RowErrors errors = block->SharedErrorsOf(state, views);
    if (errors.effect.size() > 0)
      whitening.Add(first, root_weight.segment(first, count).asDiagonal() * errors.effect, errors.owner,
                    errors.root);
    first += count;
  }
}

// Whitens weighted rows in place and appends those of the texture's means.
template <typename Matrix>
void Finish(const RowWhitening& whitening, const std::vector<TextureMean>& means, Matrix& rows) {
  const Eigen::Index count = rows.rows();
  Matrix appended = Matrix::Zero(static_cast<Eigen::Index>(means.size()), rows.cols());
  for (size_t m = 0; m < means.size(); ++m) {
    for (const auto& [row, coefficient] : means[m].terms)
      appended.row(static_cast<Eigen::Index>(m)) += coefficient * rows.row(row);
  }
  whitening.Apply(rows);
  rows.conservativeResize(count + appended.rows(), Eigen::NoChange);
  rows.bottomRows(appended.rows()) = appended;
}

}  // namespace

RowMajorMatrix RowWeights::Weighed(const RowMajorMatrix& jacobian) const {
  RowMajorMatrix weighed = root_weight.asDiagonal() * jacobian;
  Finish(whitening, means, weighed);
  return weighed;
}

Eigen::VectorXd RowWeights::Weighed(const Eigen::VectorXd& errors) const {
  Eigen::VectorXd weighed = errors.cwiseProduct(root_weight);
  Finish(whitening, means, weighed);
  return weighed;
}

std::vector<SpreadRow> RowWeights::MeansByCluster(const Eigen::VectorXd& value,
                                                  const std::vector<int>& cluster) const {
  std::vector<SpreadRow> spread;
  spread.reserve(means.size());
  for (size_t m = 0; m < means.size(); ++m) {
    std::map<int, SpreadRow::Part> parts;
    double sum = 0;
    for (const auto& [row, coefficient] : means[m].terms) {
      const int of_row = cluster[static_cast<size_t>(row)];
      SpreadRow::Part& part = parts[of_row];
      part.cluster = of_row;
      part.residual += coefficient * root_weight[row] * (value[row] - target[row]);
      part.share += std::abs(coefficient);
      sum += std::abs(coefficient);
    }
    SpreadRow of_mean{root_weight.size() + static_cast<Eigen::Index>(m), {}};
    for (auto& [of_row, part] : parts) {
      part.share /= sum;
      of_mean.parts.push_back(part);
    }
    spread.push_back(std::move(of_mean));
  }
  return spread;
}

RowWhitening WhiteningOf(const LightModel& model, const LightState& state, const TextureEstimator& elements,
                         const Eigen::VectorXd& value, const Eigen::VectorXd& root_weight,
                         const ElementTexture& texture, ViewErrors views) {
  RowWhitening whitening;
  AddTexture(elements, value, root_weight, texture, whitening);
  AddSharedErrors(model, state, root_weight, views, whitening);
  return whitening;
}

RowWeigher::RowWeigher(const Room& room, const LightData& data, const LightModel& model,
                       const RowWeigherOptions& options)
    : model_(model),
      options_(options),
      elements_(room, data),
      photo_rows_(FirstReadingRow(data)),
      materials_(static_cast<Eigen::Index>(room.scene.materials.size())) {
  const int rows = model.row_count();
  values_.resize(rows);
  variance_.resize(rows);
  is_used_.resize(static_cast<size_t>(rows));
  is_robust_.resize(static_cast<size_t>(rows));
  carries_model_error_.resize(static_cast<size_t>(rows));
  for (int i = 0; i < rows; ++i) {
    const RowBlock& block = model.BlockOf(i);
    const int place = model.PlaceInBlock(i);
    values_[i] = block.ValueOf(place);
    variance_[i] = block.VarianceOf(place);
    is_used_[static_cast<size_t>(i)] = block.IsUsed(place);
    carries_model_error_[static_cast<size_t>(i)] = model.block_index(i) == model.block_index(0);
    is_robust_[static_cast<size_t>(i)] = block.IsRobust() || carries_model_error_[static_cast<size_t>(i)];
  }
}

bool RowWeigher::HasData() const {
  return std::find(is_used_.begin(), is_used_.end(), true) != is_used_.end();
}

double RowWeigher::SigmaOf(Eigen::Index row, double relative_sigma) const {
  const double model = carries_model_error_[static_cast<size_t>(row)] ? relative_sigma * values_[row] : 0;
  return std::sqrt(variance_[row] + model * model);
}

double RowWeigher::ModelErrorRatio(const Eigen::VectorXd& z, const Eigen::VectorXd& root_weight) const {
  std::vector<double> absolute;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (root_weight[i] > 0 && carries_model_error_[static_cast<size_t>(i)])
      absolute.push_back(std::abs(z[i]));
  }
  return absolute.empty() ? 1 : Median(std::move(absolute)) / kMedianOfAbsZ;
}

RowWeights RowWeigher::Weigh(const LightState& state, const Eigen::VectorXd& value,
                             const std::vector<bool>& left_out, double photo_design_effect,
                             const RowWeights& last, double& relative_sigma) const {
  const Eigen::Index rows = values_.size();
  RowWeights weights;
  weights.weight = last.weight.size() == rows ? last.weight : Eigen::VectorXd::Ones(rows);
  weights.texture = TextureEstimator::None(rows, materials_);
  const Eigen::VectorXd residual = value - values_;
  Eigen::VectorXd plain(rows), z(rows);
  const auto refresh = [&](double least_weight, ViewErrors views) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto row = static_cast<size_t>(i);
      const bool is_usable = is_used_[row] && !left_out[row];
      const double weight = std::max(weights.weight[i], least_weight);
      plain[i] = is_usable ? std::sqrt(weight) / SigmaOf(i, relative_sigma) : 0;
    }
    // The first state of a fit may be far off: what all states then miss alike is the luminaires' fault.
    if (options_.has_texture && last.weight.size() == rows)
      weights.texture = elements_.Estimate(value, values_, plain);
    weights.root_weight = plain.cwiseProduct((1 + weights.texture.deviation.array()).matrix());
    weights.whitening =
        WhiteningOf(model_, state, elements_, value, weights.root_weight, weights.texture, views);
    z = weights.whitening.Remainder(residual.cwiseProduct(plain));
    const Eigen::VectorXd own = weights.whitening.RemainingVariance(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      constexpr double kLeastOwn = 1e-3;  // a row that another explains wholly has no scatter of its own
      const double weight = std::max(weights.weight[i], least_weight);
      z[i] /= std::sqrt(weight * std::max(own[i], kLeastOwn));
    }
  };
  constexpr int kRounds = 3;
  constexpr double kLeastWeight = 1e-6;
  for (int k = 0; k < kRounds; ++k) {
    refresh(kLeastWeight, ViewErrors::kHeld);  // f is that of photos' rows
    relative_sigma = std::clamp(relative_sigma * ModelErrorRatio(z, plain), options_.min_relative_sigma, 1.0);
  }
  refresh(kLeastWeight, ViewErrors::kJoint);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto row = static_cast<size_t>(i);
    const double robust = is_robust_[row] ? CauchyWeight(z[i], options_.robust_sigmas) : 1;
    weights.weight[i] = plain[i] > 0 ? robust : 0;
  }
  refresh(0, ViewErrors::kJoint);
  weights.means = elements_.Means(value, plain, weights.texture);
  weights.target = value;
  for (Eigen::Index i = 0; i < rows; ++i)
    weights.target[i] -= residual[i] / (1 + weights.texture.deviation[i]);
  if (photo_design_effect > 1) weights.root_weight.head(photo_rows_) /= std::sqrt(photo_design_effect);
  return weights;
}

}  // namespace luxfit
