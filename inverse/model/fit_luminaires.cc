#include "inverse/model/fit_luminaires.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "calib/luminance/median.h"
#include "inverse/model/internal/fit_covariance.h"
#include "inverse/model/internal/frozen_problem.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/null_direction.h"
#include "inverse/model/internal/part_smoothness.h"

namespace luxfit {
namespace {

class OuterLoop {
 public:
  OuterLoop(const Room& room, const LightData& data, const LightState& start,
            const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options)
      : data_(data), options_(options), model_(room, data) {
    fit_.state = start;
    fit_.relative_sigma = options.initial_relative_sigma;
    fit_.parameters = FreeParameters(room, start);
    priors_ = PriorsOf(fit_.parameters, priors);
    smoothness_ = SmoothnessRows(start, fit_.parameters);
    ReadRows();
  }

  LuminaireFit Run() {
    if (!HasData()) {
      fit_.message = "no observation and no reading to fit to";
      return fit_;
    }
    fit_.photo_design_effect = std::max(1.0, options_.photo_design_effect);
    bool settled = Settle(options_.start_is_near);
    double design_effect = fit_.photo_design_effect;
    if (options_.covariance && options_.photo_design_effect == 0 && !data_.observations.empty()) {
      design_effect = PhotoDesignEffect();
      if (HasOtherKnowledge()) {
        fit_.photo_design_effect = design_effect;
        settled = Settle(true);
      }
    }
    fit_.parameters = Recentred(fit_.parameters, fit_.state);
    Refresh(options_.covariance);
    if (options_.covariance && options_.subtracts_discretisation && !fit_.parameters.empty())
      SubtractDiscretisation();
    const bool is_known = options_.covariance || options_.photo_design_effect > 0;
    fit_.shared_relative_sigma =
        fit_.relative_sigma * (is_known ? std::sqrt(IntraClassCorrelation(design_effect)) : 1);
    fit_.status = settled ? FitStatus::kConverged : FitStatus::kNotConverged;
    fit_.message = settled ? "converged" : "luminaires still moved after the last outer iteration";
    Conclude();
    return fit_;
  }

 private:
  // Takes outer iterations until nothing moves. Returns whether that was reached.
  bool Settle(bool start_is_near) {
    bool settled = false;
    for (int outer = 0; outer < options_.max_outer_iterations && !settled; ++outer) {
      ++fit_.outer_iterations;
      const LightState before = fit_.state;
      fit_.parameters = Recentred(fit_.parameters, before);
      Refresh(true);
      const FrozenProblem problem{model_,           before,  fit_.parameters, values_,
                                  fit_.root_weight, priors_, smoothness_,     at_state_};
      Eigen::VectorXd x = PackParameters(before, fit_.parameters);
      const bool is_near = start_is_near || outer >= 2;
      SolveFrozen(problem, {options_.max_inner_iterations, is_near}, x);
      fit_.state = WithParameters(before, fit_.parameters, x);
      settled = is_near &&
                LargestMove(before.luminaires, fit_.state.luminaires) < options_.position_tolerance_m &&
                (std::abs(relative_sigma_before_ / fit_.relative_sigma - 1) < 0.02 ||
                 fit_.relative_sigma < 2 * options_.min_relative_sigma);  // there f only creeps
    }
    return settled;
  }

  // Returns whether rows other than photos', or priors, share a parameter with the photos: only then their
  // weights against one another matter.
  bool HasOtherKnowledge() const {
    const auto photos = static_cast<std::ptrdiff_t>(data_.observations.size());
    return photos > 0 &&
           (!priors_.empty() || std::find(is_used_.begin() + photos, is_used_.end(), true) != is_used_.end());
  }

  // Residuals of photos resemble one another: facets whose rows all err alike know less than they seem to.
  double PhotoDesignEffect() {
    fit_.parameters = Recentred(fit_.parameters, fit_.state);
    Refresh(true);
    WeightedRows rows = RowsAtState();
    for (size_t i = data_.observations.size(); i < rows.cluster.size(); ++i) rows.cluster[i] = -1;
    return DesignEffect(rows);
  }

  // Inverts Kish's design effect 1 + (n - 1) rho, n: mean size of a row's cluster. 1 without photos.
  double IntraClassCorrelation(double design_effect) const {
    std::map<std::pair<int, int>, double> size;
    for (Eigen::Index i = 0; i < FirstReadingRow(data_); ++i) {
      const int row = static_cast<int>(i);
      const auto cluster = model_.BlockOf(row).ClusterOf(model_.PlaceInBlock(row));
      if (cluster && is_usable_[static_cast<size_t>(i)]) ++size[*cluster];
    }
    double rows = 0, squares = 0;
    for (const auto& [cluster, count] : size) rows += count, squares += count * count;
    return squares > rows ? std::min(1.0, (design_effect - 1) / (squares / rows - 1)) : 1;
  }

  // Reads from the blocks what no state changes.
  void ReadRows() {
    const int rows = model_.row_count();
    values_.resize(rows);
    variance_.resize(rows);
    bias_.setZero(rows);
    is_used_.resize(static_cast<size_t>(rows));
    is_robust_.resize(static_cast<size_t>(rows));
    carries_model_error_.resize(static_cast<size_t>(rows));
    for (int i = 0; i < rows; ++i) {
      const RowBlock& block = model_.BlockOf(i);
      const int place = model_.PlaceInBlock(i);
      values_[i] = block.ValueOf(place);
      variance_[i] = block.VarianceOf(place);
      is_used_[static_cast<size_t>(i)] = block.IsUsed(place);
      carries_model_error_[static_cast<size_t>(i)] = model_.block_index(i) == model_.block_index(0);
      is_robust_[static_cast<size_t>(i)] = block.IsRobust() || carries_model_error_[static_cast<size_t>(i)];
    }
  }

  bool HasData() const { return std::find(is_used_.begin(), is_used_.end(), true) != is_used_.end(); }

  // Updates visibility, model error and weights at the present state.
  void Refresh(bool with_jacobian) {
    // Shadow edges move about as far as the luminaires; rows at an edge are left out anyway.
    constexpr double kStillM = 2e-3;
    if (frozen_.empty() || LargestMove(frozen_, fit_.state.luminaires) > kStillM) {
      model_.FreezeVisibility(fit_.state, options_.visibility_order);
      frozen_ = fit_.state.luminaires;
    }
    const std::vector<bool> penumbra = model_.InPenumbra();
    at_state_ = model_.Predict(fit_.state, fit_.parameters, with_jacobian);
    const Eigen::VectorXd residual = at_state_.value - values_;
    relative_sigma_before_ = fit_.relative_sigma;
    is_usable_ = is_used_;
    for (size_t i = 0; i < is_usable_.size(); ++i) is_usable_[i] = is_used_[i] && !penumbra[i];
    EstimateRelativeSigma(residual);
    fit_.weight.setZero(values_.size());
    fit_.root_weight.setZero(values_.size());
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
      if (!is_usable_[static_cast<size_t>(i)]) continue;
      const double sigma = SigmaOf(i);
      const double z = residual[i] / (options_.robust_sigmas * sigma);
      fit_.weight[i] = is_robust_[static_cast<size_t>(i)] ? 1 / (1 + z * z) : 1;
      fit_.root_weight[i] = std::sqrt(fit_.weight[i]) / sigma;
      if (i < FirstReadingRow(data_)) fit_.root_weight[i] /= std::sqrt(fit_.photo_design_effect);
    }
  }

  double SigmaOf(Eigen::Index row) const {
    const double model =
        carries_model_error_[static_cast<size_t>(row)] ? fit_.relative_sigma * values_[row] : 0;
    return std::hypot(std::sqrt(variance_[row]), model);
  }

  // Finds f by a damped fixed point: the median absolute normalised residual is to be a Gaussian's.
  void EstimateRelativeSigma(const Eigen::VectorXd& residual) {
    for (int k = 0; k < 3; ++k) {
      std::vector<double> absolute;
      for (Eigen::Index i = 0; i < residual.size(); ++i) {
        const auto row = static_cast<size_t>(i);
        if (is_usable_[row] && carries_model_error_[row])
          absolute.push_back(std::abs(residual[i]) / SigmaOf(i));
      }
      if (absolute.empty()) return;
      fit_.relative_sigma =
          std::clamp(fit_.relative_sigma * Median(absolute) / 0.6745, options_.min_relative_sigma, 1.0);
    }
  }

  // Returns the largest move of any point of any luminaire, in m.
  static double LargestMove(const std::vector<Luminaire>& a, const std::vector<Luminaire>& b) {
    double move = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      const double turn = (a[k].aim - b[k].aim).norm() * 0.5 * a[k].size_m.maxCoeff();
      const double growth = 0.5 * (a[k].size_m - b[k].size_m).cwiseAbs().maxCoeff();
      move = std::max(move, (a[k].position - b[k].position).norm() + turn + growth);
    }
    return move;
  }

  // Moves to the minimum of the same problem with its discretisation's bias added to the model: one
  // Gauss-Newton step, for the bias is small. Weights stay.
  void SubtractDiscretisation() {
    bias_ = BlockBias();
    const Eigen::MatrixXd jacobian = fit_.root_weight.asDiagonal() * at_state_.jacobian;
    const Eigen::VectorXd step = -InverseOf(jacobian.transpose() * jacobian + PriorInformation()) *
                                 (jacobian.transpose() * bias_.cwiseProduct(fit_.root_weight));
    Eigen::VectorXd x = PackParameters(fit_.state, fit_.parameters) + step;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Parameter& p = fit_.parameters[static_cast<size_t>(i)];
      x[i] = std::clamp(x[i], p.lower, p.upper);
    }
    fit_.state = WithParameters(fit_.state, fit_.parameters, x);
    fit_.parameters = Recentred(fit_.parameters, fit_.state);
    at_state_ = model_.Predict(fit_.state, fit_.parameters, true);
  }

  // Computes the covariance, the undetermined directions and the predictions of the readings.
  void Conclude() {
    fit_.predicted = at_state_.value;
    const auto readings = static_cast<Eigen::Index>(data_.readings.size());
    fit_.reading_direct_lx = at_state_.direct.segment(FirstReadingRow(data_), readings);
    const Eigen::VectorXd x = PackParameters(fit_.state, fit_.parameters);
    for (size_t i = 0; i < fit_.parameters.size(); ++i) {
      const Parameter& p = fit_.parameters[i];
      const double margin = 1e-6 * std::max(1.0, p.upper - p.lower);
      const double value = x[static_cast<Eigen::Index>(i)];
      // A dark part at its bound needs no warning.
      if (p.kind == ParameterKind::kLuminaire && p.reference != p.part) continue;
      if (value < p.lower + margin || value > p.upper - margin) fit_.at_bound.push_back(p.id());
    }
    if (!options_.covariance || fit_.parameters.empty()) return;
    const WeightedRows rows = RowsAtState();
    fit_.effective_parts =
        EffectiveParts(rows.jacobian.transpose() * rows.jacobian, smoothness_, fit_.parameters);
    const FitCovariance found = CovarianceOf(rows);
    fit_.covariance = found.covariance;
    for (const Eigen::VectorXd& direction : found.null_directions) NameNullDirection(direction);
    const Eigen::MatrixXd reading_jacobian = at_state_.jacobian.middleRows(FirstReadingRow(data_), readings);
    fit_.reading_sigma_lx =
        (reading_jacobian * fit_.covariance * reading_jacobian.transpose()).diagonal().cwiseSqrt();
  }

  void NameNullDirection(const Eigen::VectorXd& direction) {
    for (Eigen::Index i = 0; i < direction.size(); ++i) {
      if (std::abs(direction[i]) > 0.1)
        fit_.undetermined.push_back(fit_.parameters[static_cast<size_t>(i)].id());
    }
    fit_.null_directions.push_back(DescribeNullDirection(fit_.parameters, direction));
    fit_.status = FitStatus::kUndetermined;
    fit_.message = "the data leave a combination of parameters undetermined";
  }

  WeightedRows RowsAtState() const {
    WeightedRows rows;
    rows.jacobian = fit_.root_weight.asDiagonal() * at_state_.jacobian;
    rows.residual = (at_state_.value + bias_ - values_).cwiseProduct(fit_.root_weight);
    rows.biases = fit_.root_weight.asDiagonal() * Biases();
    std::map<std::tuple<int, int, int>, int> clusters;
    std::map<std::pair<int, int>, int> coarse;  // all states of a facet
    for (int i = 0; i < model_.row_count(); ++i) {
      const auto cluster = model_.BlockOf(i).ClusterOf(model_.PlaceInBlock(i));
      const int next = static_cast<int>(clusters.size());
      const int block = model_.block_index(i);
      rows.cluster.push_back(
          cluster ? clusters.try_emplace({block, cluster->first, cluster->second}, next).first->second : -1);
      const int next_coarse = static_cast<int>(coarse.size());
      rows.coarse_cluster.push_back(
          cluster ? coarse.try_emplace({block, cluster->first}, next_coarse).first->second : -1);
    }
    rows.alone_scatter = AloneScatter(rows);
    rows.prior_information = PriorInformation();
    return rows;
  }

  Eigen::MatrixXd PriorInformation() const {
    const auto n = static_cast<Eigen::Index>(fit_.parameters.size());
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
    for (const auto& [parameter, prior] : priors_)
      information(parameter, parameter) += 1 / (prior.sigma * prior.sigma);
    AddSmoothness(smoothness_, information);
    return information;
  }

  // Returns what the model's discretisation leaves out of each row.
  Eigen::VectorXd BlockBias() const {
    Eigen::VectorXd bias(values_.size());
    Eigen::Index first = 0;
    for (const auto& block : model_.blocks()) {
      const Eigen::Index count = block->row_count();
      if (count > 0) bias.segment(first, count) = block->BiasOf(fit_.state);
      first += count;
    }
    return bias;
  }

  // Returns what remains of the discretisation's bias, errors that the rows of a block share, and an error of the
  // bodies' reflectance.
  Eigen::MatrixXd Biases() const {
    // The bias is extrapolated from two sizes; a third of it may be left.
    constexpr double kBiasLeft = 1.0 / 3;
    Eigen::MatrixXd biases(values_.size(), at_state_.d_body.size() > 0 ? 3 : 2);
    biases.col(0) = kBiasLeft * bias_;
    if (biases.cols() > 2) biases.col(2) = kBodyAlbedoSigma * at_state_.d_body;
    Eigen::Index first = 0;
    for (const auto& block : model_.blocks()) {
      const Eigen::Index count = block->row_count();
      if (count == 0) continue;
      biases.col(1).segment(first, count) = block->SharedErrorOf(fit_.state);
      first += count;
    }
    return biases;
  }

  // Returns the mean square of the normalised residuals of rows that stand alone, at least 1. A reading's
  // stated sigma counts even where the fit passes through it (a scale reading leaves no residual). One mean
  // serves all: max(1, z^2) of each row would average 1.48 with correct sigmas.
  double AloneScatter(const WeightedRows& rows) const {
    double squares = 0;
    int used = 0;
    for (size_t i = 0; i < rows.cluster.size(); ++i) {
      if (rows.cluster[i] >= 0) continue;
      const auto row = static_cast<Eigen::Index>(i);
      squares += rows.residual[row] * rows.residual[row];
      used += fit_.root_weight[row] > 0 ? 1 : 0;
    }
    return used > 0 ? std::max(1.0, squares / used) : 1.0;
  }

  const LightData& data_;
  const FitLuminairesOptions& options_;
  LightModel model_;
  LuminaireFit fit_;
  IndexedPriors priors_;
  std::vector<Luminaire> frozen_;  // luminaires at which the visibility was computed
  std::vector<SmoothnessRow> smoothness_;
  Eigen::VectorXd values_, variance_;
  Eigen::VectorXd bias_;  // of each row by the model's discretisation; 0 until it is subtracted
  std::vector<bool> is_used_, is_usable_;  // fitted to; fitted to and not spoilt at the present state
  std::vector<bool> is_robust_;
  std::vector<bool> carries_model_error_;  // rows of the first block that has any
  Prediction at_state_;
  double relative_sigma_before_ = 0;
};

}  // namespace

LuminaireFit FitLuminaires(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options) {
  return OuterLoop(room, data, start, priors, options).Run();
}

}  // namespace luxfit
