#include "inverse/model/fit_luminaires.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "calib/luminance/median.h"
#include "inverse/model/internal/discretisation_bias.h"
#include "inverse/model/internal/fit_covariance.h"
#include "inverse/model/internal/frozen_problem.h"
#include "inverse/model/internal/part_smoothness.h"

namespace luxfit {
namespace {

class OuterLoop {
 public:
  OuterLoop(const Room& room, const LightData& data, const LightState& start,
            const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options)
      : room_(room), data_(data), options_(options), model_(room, data) {
    fit_.state = start;
    fit_.relative_sigma = options.initial_relative_sigma;
    fit_.parameters = FreeParameters(room, start);
    for (const ParameterPrior& prior : priors) AddPrior(prior);
    smoothness_ = SmoothnessRows(start, fit_.parameters);
    values_.resize(model_.row_count());
    const size_t observations = data.observations.size();
    for (size_t i = 0; i < observations; ++i) {
      values_[static_cast<Eigen::Index>(i)] = data.observations[i].relative_luminance;
    }
    for (size_t i = 0; i < data.readings.size(); ++i) {
      values_[static_cast<Eigen::Index>(observations + i)] = data.readings[i].illuminance_lx;
    }
  }

  LuminaireFit Run() {
    if (!HasData()) {
      fit_.message = "no observation and no reading to fit to";
      return fit_;
    }
    bool settled = false;
    for (int outer = 0; outer < options_.max_outer_iterations && !settled; ++outer) {
      fit_.outer_iterations = outer + 1;
      const LightState before = fit_.state;
      fit_.parameters = Recentred(fit_.parameters, before);
      Refresh(true);
      const FrozenProblem problem{model_,       before,  fit_.parameters, values_,
                                  root_weight_, priors_, smoothness_,     at_state_};
      Eigen::VectorXd x = PackParameters(before, fit_.parameters);
      const bool is_near = options_.start_is_near || outer >= 2;
      fit_.cost = SolveFrozen(problem, {options_.max_inner_iterations, is_near}, x);
      fit_.state = WithParameters(before, fit_.parameters, x);
      settled = is_near &&
                LargestMove(before.luminaires, fit_.state.luminaires) < options_.position_tolerance_m &&
                (std::abs(relative_sigma_before_ / fit_.relative_sigma - 1) < 0.02 ||
                 fit_.relative_sigma < 2 * options_.min_relative_sigma);  // there f only creeps
    }
    fit_.parameters = Recentred(fit_.parameters, fit_.state);
    Refresh(options_.covariance);
    fit_.status = settled ? FitStatus::kConverged : FitStatus::kNotConverged;
    fit_.message = settled ? "converged" : "luminaires still moved after the last outer iteration";
    Conclude();
    return fit_;
  }

 private:
  void AddPrior(const ParameterPrior& prior) {
    for (size_t i = 0; i < fit_.parameters.size(); ++i) {
      const Parameter& p = fit_.parameters[i];
      const bool same = p.kind == prior.kind && p.index == prior.index &&
                        (p.kind != ParameterKind::kLuminaire || p.quantity == prior.quantity);
      if (same) priors_.push_back({static_cast<int>(i), prior});
    }
  }

  bool HasData() const {
    return !data_.observations.empty() ||
           std::any_of(data_.readings.begin(), data_.readings.end(), [](const Reading& r) { return r.used; });
  }

  // Visibility, model error and weights at the present state.
  void Refresh(bool with_jacobian) {
    // Shadow edges move about as much as what casts them: rows at an edge are left out anyway.
    constexpr double kStillM = 2e-3;
    if (frozen_.empty() || LargestMove(frozen_, fit_.state.luminaires) > kStillM) {
      model_.FreezeVisibility(fit_.state, options_.visibility_order);
      frozen_ = fit_.state.luminaires;
    }
    const std::vector<bool> penumbra = model_.InPenumbra();
    at_state_ = model_.Predict(fit_.state, fit_.parameters, with_jacobian);
    const Eigen::VectorXd residual = at_state_.value - values_;
    relative_sigma_before_ = fit_.relative_sigma;
    EstimateRelativeSigma(residual, penumbra);
    const Eigen::Index observations = static_cast<Eigen::Index>(data_.observations.size());
    fit_.weight.setZero(values_.size());
    root_weight_.setZero(values_.size());
    for (Eigen::Index i = 0; i < values_.size(); ++i) {
      const bool usable = i < observations ? !penumbra[static_cast<size_t>(i)]
                                           : data_.readings[static_cast<size_t>(i - observations)].used;
      if (!usable) continue;
      const double sigma = SigmaOf(i);
      const double z = residual[i] / (options_.robust_sigmas * sigma);
      // Readings are few and each was meant: they are not down-weighted unless they are the bulk of the data.
      fit_.weight[i] = i < observations || observations == 0 ? 1 / (1 + z * z) : 1;
      root_weight_[i] = std::sqrt(fit_.weight[i]) / sigma;
    }
  }

  double SigmaOf(Eigen::Index row) const {
    const Eigen::Index observations = static_cast<Eigen::Index>(data_.observations.size());
    if (row < observations) {
      const Observation& o = data_.observations[static_cast<size_t>(row)];
      return std::sqrt(o.variance + std::pow(fit_.relative_sigma * o.relative_luminance, 2));
    }
    const Reading& reading = data_.readings[static_cast<size_t>(row - observations)];
    const double model = observations == 0 ? fit_.relative_sigma * reading.illuminance_lx : 0;
    return std::hypot(reading.sigma_lx, model);
  }

  // f such that the median absolute normalised residual is that of a Gaussian; a damped fixed point.
  void EstimateRelativeSigma(const Eigen::VectorXd& residual, const std::vector<bool>& penumbra) {
    for (int k = 0; k < 3; ++k) {
      std::vector<double> absolute;
      for (Eigen::Index i = 0; i < residual.size(); ++i) {
        const Eigen::Index observations = static_cast<Eigen::Index>(penumbra.size());
        if (i < observations && penumbra[static_cast<size_t>(i)]) continue;
        if (i >= observations &&
            (observations > 0 || !data_.readings[static_cast<size_t>(i - observations)].used))
          continue;
        absolute.push_back(std::abs(residual[i]) / SigmaOf(i));
      }
      if (absolute.empty()) return;
      fit_.relative_sigma =
          std::clamp(fit_.relative_sigma * Median(absolute) / 0.6745, options_.min_relative_sigma, 1.0);
    }
  }

  // Of any point of any luminaire, m.
  static double LargestMove(const std::vector<Luminaire>& a, const std::vector<Luminaire>& b) {
    double move = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      const double turn = (a[k].aim - b[k].aim).norm() * 0.5 * a[k].size_m.maxCoeff();
      const double growth = 0.5 * (a[k].size_m - b[k].size_m).cwiseAbs().maxCoeff();
      move = std::max(move, (a[k].position - b[k].position).norm() + turn + growth);
    }
    return move;
  }

  // Covariance, what is undetermined, predictions of the readings.
  void Conclude() {
    fit_.predicted = at_state_.value;
    fit_.reading_direct_lx = at_state_.reading_direct_lx;
    const Eigen::VectorXd x = PackParameters(fit_.state, fit_.parameters);
    for (size_t i = 0; i < fit_.parameters.size(); ++i) {
      const Parameter& p = fit_.parameters[i];
      const double margin = 1e-6 * std::max(1.0, p.upper - p.lower);
      const double value = x[static_cast<Eigen::Index>(i)];
      // Dark parts are nothing to warn of.
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
    const Eigen::Index readings = static_cast<Eigen::Index>(data_.readings.size());
    const Eigen::MatrixXd reading_jacobian = at_state_.jacobian.bottomRows(readings);
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

  // Clusters are the observations of one facet in one state; readings stand alone.
  WeightedRows RowsAtState() const {
    WeightedRows rows;
    rows.jacobian = root_weight_.asDiagonal() * at_state_.jacobian;
    rows.residual = (at_state_.value - values_).cwiseProduct(root_weight_);
    rows.bias = Eigen::VectorXd::Zero(values_.size());
    const Eigen::Index observations = static_cast<Eigen::Index>(data_.observations.size());
    if (observations > 0)
      rows.bias.head(observations) =
          DiscretisationBias(room_, data_, fit_.state).cwiseProduct(root_weight_.head(observations));
    std::map<std::pair<int, int>, int> clusters;
    for (const Observation& o : data_.observations) {
      const int patch = room_.patches.elements[static_cast<size_t>(o.element)].patch;
      const int facet = room_.patches.patches[static_cast<size_t>(patch)].facet;
      const int next = static_cast<int>(clusters.size());
      rows.cluster.push_back(clusters.try_emplace({facet, o.state}, next).first->second);
    }
    rows.cluster.resize(static_cast<size_t>(values_.size()), -1);
    rows.alone_scatter = ReadingScatter(rows.residual.tail(values_.size() - observations));
    const Eigen::Index n = at_state_.jacobian.cols();
    rows.prior_information = Eigen::MatrixXd::Zero(n, n);
    for (const auto& [parameter, prior] : priors_)
      rows.prior_information(parameter, parameter) += 1 / (prior.sigma * prior.sigma);
    AddSmoothness(smoothness_, rows.prior_information);
    return rows;
  }

  // Mean square of the readings' normalised residuals, never below 1: a reading's stated sigma counts even
  // where the fit passes through it (a scale reading leaves no residual). One mean for all: max(1, z^2) of
  // each would be 1.48 on average where nothing is wrong.
  double ReadingScatter(const Eigen::VectorXd& residual) const {
    const Eigen::Index used = (root_weight_.tail(residual.size()).array() > 0).count();
    return used > 0 ? std::max(1.0, residual.squaredNorm() / static_cast<double>(used)) : 1.0;
  }

  const Room& room_;
  const LightData& data_;
  const FitLuminairesOptions& options_;
  LightModel model_;
  LuminaireFit fit_;
  std::vector<std::pair<int, ParameterPrior>> priors_;
  std::vector<Luminaire> frozen_;  // where the visibility is of
  std::vector<SmoothnessRow> smoothness_;
  Eigen::VectorXd values_, root_weight_;
  Prediction at_state_;
  double relative_sigma_before_ = 0;
};

}  // namespace

LuminaireFit FitLuminaires(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options) {
  return OuterLoop(room, data, start, priors, options).Run();
}

}  // namespace luxfit
