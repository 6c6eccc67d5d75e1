#include "inverse/fit_luminaires.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "inverse/internal/discretisation_bias.h"
#include "inverse/internal/fit_covariance.h"
#include "inverse/part_smoothness.h"

namespace luxfit {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Everything that one inner solve holds still.
struct FrozenProblem {
  const LightModel& model;
  const LightState& base;  // tilts are relative to its aims
  const std::vector<Parameter>& parameters;
  Eigen::VectorXd data;
  Eigen::VectorXd root_weight;                         // sqrt(w) / sigma, 0 for rows left out
  std::vector<std::pair<int, ParameterPrior>> priors;  // parameter, knowledge
  std::vector<SmoothnessRow> smoothness;
};

class ModelCost : public ceres::CostFunction {
 public:
  explicit ModelCost(const FrozenProblem& problem) : problem_(problem) {
    set_num_residuals(static_cast<int>(
        problem.data.size() + static_cast<Eigen::Index>(problem.priors.size() + problem.smoothness.size())));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.parameters.size()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const Eigen::Index n = static_cast<Eigen::Index>(problem_.parameters.size()), rows = problem_.data.size();
    const Eigen::Map<const Eigen::VectorXd> x(blocks[0], n);
    const bool with_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    // A step is first asked for its cost, and if that is good, as nearly all are, for its Jacobian.
    if (!prediction_ || predicted_at_ != x) {
      prediction_ = problem_.model.Predict(WithParameters(problem_.base, problem_.parameters, x),
                                           problem_.parameters, true);
      predicted_at_ = x;
    }
    const Prediction& prediction = *prediction_;
    if (!prediction.value.allFinite()) return false;
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    r.head(rows) = (prediction.value - problem_.data).cwiseProduct(problem_.root_weight);
    if (with_jacobian) {
      Eigen::Map<RowMajorMatrix> j(jacobians[0], num_residuals(), n);
      j.topRows(rows) = problem_.root_weight.asDiagonal() * prediction.jacobian;
      j.bottomRows(num_residuals() - rows).setZero();
    }
    for (size_t p = 0; p < problem_.priors.size(); ++p) {
      const auto& [parameter, prior] = problem_.priors[p];
      const Eigen::Index row = rows + static_cast<Eigen::Index>(p);
      r[row] = (x[parameter] - prior.mean) / prior.sigma;
      if (with_jacobian) jacobians[0][row * n + parameter] = 1 / prior.sigma;
    }
    Eigen::Index row = rows + static_cast<Eigen::Index>(problem_.priors.size());
    for (const SmoothnessRow& smooth : problem_.smoothness) {
      r[row] = smooth.Value(x);
      for (size_t t = 0; with_jacobian && t < smooth.terms.size(); ++t)
        jacobians[0][row * n + smooth.terms[t].first] = smooth.terms[t].second;
      ++row;
    }
    return true;
  }

 private:
  const FrozenProblem& problem_;
  mutable Eigen::VectorXd predicted_at_;
  mutable std::optional<Prediction> prediction_;
};

// `is_near`: steps need no damping. A direction that one reading alone fixes (the scale of all fluxes) has so
// little weight beside thousands of pixels that damped steps stop tenths of a percent short of it.
double SolveInner(const FrozenProblem& problem, int max_iterations, bool is_near, Eigen::VectorXd& x) {
  if (x.size() == 0) {  // everything is given: nothing to solve, and Ceres aborts on an empty block
    const double* const block = x.data();
    Eigen::VectorXd residuals(problem.data.size());
    ModelCost(problem).Evaluate(&block, residuals.data(), nullptr);
    return 0.5 * residuals.squaredNorm();
  }
  ceres::Problem ceres_problem;
  ceres_problem.AddResidualBlock(new ModelCost(problem), nullptr, x.data());
  for (size_t i = 0; i < problem.parameters.size(); ++i) {
    ceres_problem.SetParameterLowerBound(x.data(), static_cast<int>(i), problem.parameters[i].lower);
    ceres_problem.SetParameterUpperBound(x.data(), static_cast<int>(i), problem.parameters[i].upper);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = is_near ? 1e-10 : 1e-6;  // the outer loop goes on from here
  options.parameter_tolerance = 1e-7;
  options.initial_trust_region_radius = is_near ? 1e8 : 10;
  // Bounds are seldom met: a line search along every step to them costs a third of the time and finds
  // nothing.
  options.max_num_line_search_step_size_iterations = 0;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  return summary.final_cost;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
      Refresh();
      const FrozenProblem problem{model_,       before,  fit_.parameters, values_,
                                  root_weight_, priors_, smoothness_};
      Eigen::VectorXd x = PackParameters(before, fit_.parameters);
      const int rough_rounds = options_.start_is_near ? 0 : 2;
      fit_.cost = SolveInner(problem, options_.max_inner_iterations, outer >= rough_rounds, x);
      fit_.state = WithParameters(before, fit_.parameters, x);
      settled = outer >= rough_rounds &&
                LargestMove(before.luminaires, fit_.state.luminaires) < options_.position_tolerance_m &&
                (std::abs(relative_sigma_before_ / fit_.relative_sigma - 1) < 0.02 ||
                 fit_.relative_sigma < 2 * options_.min_relative_sigma);  // there f only creeps
    }
    Refresh();
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
  void Refresh() {
    // Shadow edges move about as much as what casts them: rows at an edge are left out anyway.
    constexpr double kStillM = 2e-3;
    if (frozen_.empty() || LargestMove(frozen_, fit_.state.luminaires) > kStillM) {
      model_.FreezeVisibility(fit_.state, options_.visibility_order);
      frozen_ = fit_.state.luminaires;
    }
    const std::vector<bool> penumbra = model_.InPenumbra();
    fit_.predicted = model_.Predict(fit_.state, {}, false).value;
    const Eigen::VectorXd residual = fit_.predicted - values_;
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
    Prediction prediction = model_.Predict(fit_.state, fit_.parameters, options_.covariance);
    fit_.predicted = prediction.value;
    fit_.reading_direct_lx = prediction.reading_direct_lx;
    const Eigen::VectorXd x = PackParameters(fit_.state, fit_.parameters);
    for (size_t i = 0; i < fit_.parameters.size(); ++i) {
      const Parameter& p = fit_.parameters[i];
      const double margin = 1e-6 * std::max(1.0, p.upper - p.lower);
      const double value = x[static_cast<Eigen::Index>(i)];
      // Dark parts are nothing to warn of.
      if (p.kind == ParameterKind::kLuminaire && p.reference != p.part) continue;
      if (value < p.lower + margin || value > p.upper - margin) fit_.at_bound.push_back(p.name);
    }
    if (!options_.covariance || fit_.parameters.empty()) return;
    const WeightedRows rows = RowsOf(prediction);
    fit_.effective_parts =
        EffectiveParts(rows.jacobian.transpose() * rows.jacobian, smoothness_, fit_.parameters);
    const FitCovariance found = CovarianceOf(rows);
    fit_.covariance = found.covariance;
    for (const Eigen::VectorXd& direction : found.null_directions) NameNullDirection(direction);
    const Eigen::Index readings = static_cast<Eigen::Index>(data_.readings.size());
    const Eigen::MatrixXd reading_jacobian = prediction.jacobian.bottomRows(readings);
    fit_.reading_sigma_lx =
        (reading_jacobian * fit_.covariance * reading_jacobian.transpose()).diagonal().cwiseSqrt();
  }

  void NameNullDirection(const Eigen::VectorXd& direction) {
    for (Eigen::Index i = 0; i < direction.size(); ++i) {
      if (std::abs(direction[i]) > 0.1)
        fit_.undetermined.push_back(fit_.parameters[static_cast<size_t>(i)].name);
    }
    fit_.null_directions.push_back(DescribeNullDirection(fit_.parameters, direction));
    fit_.status = FitStatus::kUndetermined;
    fit_.message = "the data leave a combination of parameters undetermined";
  }

  // Clusters are the observations of one facet in one state; readings stand alone.
  WeightedRows RowsOf(const Prediction& prediction) const {
    WeightedRows rows;
    rows.jacobian = root_weight_.asDiagonal() * prediction.jacobian;
    rows.residual = (prediction.value - values_).cwiseProduct(root_weight_);
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
    const Eigen::Index n = prediction.jacobian.cols();
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
  double relative_sigma_before_ = 0;
};

}  // namespace

LuminaireFit FitLuminaires(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options) {
  return OuterLoop(room, data, start, priors, options).Run();
}

}  // namespace luxfit
