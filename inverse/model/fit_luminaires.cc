#include "inverse/model/fit_luminaires.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "inverse/model/internal/frozen_problem.h"
#include "inverse/model/internal/intervals/fit_covariance.h"
#include "inverse/model/internal/intervals/null_direction.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"
#include "inverse/model/internal/relaxation.h"
#include "inverse/model/internal/weights/indirect_error.h"
#include "inverse/model/internal/weights/row_weights.h"
#include "inverse/model/internal/weights/shared_errors.h"

namespace luxfit {
namespace {

constexpr double kLastStepSigmas = 0.1;  // of a step that ends the outer loop
// Texture and robust weights start from nothing. Where the start is near, they settle there before the first step:
// steps by unsettled weights would lead away, and back over ten rounds.
constexpr int kMostWeighings = 20;
constexpr double kSettledWeights = 0.01;  // relative change of f
constexpr int kMostDesignEffects = 5;
constexpr double kSettledDesignEffect = 0.9;  // of the one before

class OuterLoop {
 public:
  OuterLoop(const Room& room, const LightData& data, const LightState& start,
            const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options)
      : room_(room),
        data_(data),
        options_(options),
        model_(room, data),
        weigher_(room, data, model_,
                 {options.robust_sigmas, options.min_relative_sigma, options.has_texture}) {
    bias_.setZero(model_.row_count());
    fit_.state = start;
    fit_.relative_sigma = options.initial_relative_sigma;
    fit_.parameters = FreeParameters(room, start);
    priors_ = PriorsOf(fit_.parameters, priors);
    smoothness_ = SmoothnessRows(start, fit_.parameters);
    if (options.frozen) model_.TakeOver(*options.frozen);
  }

  LuminaireFit Run() {
    if (!weigher_.HasData()) {
      fit_.message = "no observation and no reading to fit to";
      return fit_;
    }
    fit_.photo_design_effect = std::max(1.0, options_.photo_design_effect);
    const bool is_unknown =
        options_.covariance && options_.photo_design_effect == 0 && !data_.observations.empty();
    // Photos that know less than they seem to would move luminaires away from their outlines, where robust weights keep
    // them.
    if (is_unknown && options_.start_is_near && HasOtherKnowledge())
      fit_.photo_design_effect = PhotoDesignEffect();
    bool settled = Settle(options_.start_is_near);
    if (ExchangesTexturedLight()) settled = Settle(true);
    double design_effect = fit_.photo_design_effect;
    if (is_unknown) {
      design_effect = PhotoDesignEffect();
      // Away from the photos' own optimum their residuals resemble one another more, so the estimate is repeated while it
      // falls. It is not followed upwards: weaker photos bend a smooth table less, which leaves residuals more alike.
      for (int i = 0; i < kMostDesignEffects && HasOtherKnowledge(); ++i) {
        const double before = design_effect;
        fit_.photo_design_effect = before;
        settled = Settle(true);
        design_effect = PhotoDesignEffect();
        fit_.photo_design_effect = before;
        if (design_effect > kSettledDesignEffect * before) break;
      }
    }
    Recentre();
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
    Eigen::VectorXd last_step;
    ReflectDerivatives(!options_.steps_by_direct_light);
    for (int outer = 0; outer < options_.max_outer_iterations && !settled; ++outer) {
      if (data_.checkpoint) data_.checkpoint(data_.is_part);
      ++fit_.outer_iterations;
      const LightState before = fit_.state;
      Recentre();
      Refresh(true);
      const FrozenProblem problem{model_, before, fit_.parameters, weights_, priors_, smoothness_, at_state_};
      Eigen::VectorXd x = PackParameters(before, fit_.parameters);
      bool is_near = start_is_near || outer >= 2;
      solved_ = SolveFrozen(problem, InnerOptions(is_near), x);
      if (is_near && !IsNear(before, WithParameters(before, fit_.parameters, x))) {
        is_near = false;
        x = PackParameters(before, fit_.parameters);
        solved_ = SolveFrozen(problem, InnerOptions(is_near), x);
      }
      fit_.state = WithParameters(before, fit_.parameters, x);
      const Eigen::VectorXd step = x - PackParameters(before, fit_.parameters);
      settled = is_near &&
                (LargestMove(before.luminaires, fit_.state.luminaires) < options_.position_tolerance_m ||
                 StepInSigmas(step) < kLastStepSigmas) &&
                (std::abs(model_error_ratio_ - 1) < 0.02 ||
                 fit_.relative_sigma < 2 * options_.min_relative_sigma);  // there f only creeps
      if (is_near && !settled) {
        if (last_step.size() == step.size()) relaxation_.Compare(Moved(step), Moved(last_step));
        if (relaxation_.IsPartial()) {
          fit_.state = WithParameters(before, fit_.parameters, relaxation_.PartOf(step, x));
          solved_.reset();
        }
      }
      last_step = is_near ? step : Eigen::VectorXd();
      if (options_.on_round) options_.on_round({fit_.outer_iterations, fit_.relative_sigma, fit_.state});
    }
    ReflectDerivatives(true);
    relaxation_ = {};
    return settled;
  }

  InnerSolveOptions InnerOptions(bool is_near) const {
    InnerSolveOptions options;
    options.max_iterations = options_.max_inner_iterations;
    options.is_near = is_near;
    options.negligible_decrease =
        kLastStepSigmas * kLastStepSigmas * static_cast<double>(fit_.parameters.size());
    return options;
  }

  // Lets turns count from where the luminaires point now.
  void Recentre() {
    std::vector<Parameter> recentred = Recentred(fit_.parameters, fit_.state);
    const auto is_alike = [](const Parameter& a, const Parameter& b) {
      return a.frame.along == b.frame.along && a.frame.across == b.frame.across;
    };
    if (!std::equal(recentred.begin(), recentred.end(), fit_.parameters.begin(), is_alike)) solved_.reset();
    fit_.parameters = std::move(recentred);
  }

  void ReflectDerivatives(bool reflects) {
    if (options_.steps_by_direct_light) solved_.reset();
    model_.ReflectDerivatives(reflects);
  }

  // Lets patches reflect as their elements' texture says. Returns whether that matters.
  bool ExchangesTexturedLight() {
    if (data_.indirect_is_held || room_.sparse) return false;
    Refresh(true);
    fit_.patch_factor = weigher_.elements().PatchFactors(room_, weights_.texture);
    if (fit_.patch_factor.size() == 0) return false;
    model_.SetPatchFactor(fit_.patch_factor);
    model_.FreezeReflected(fit_.state);
    solved_.reset();
    return true;
  }

  // Returns whether rows other than photos', or priors, share a parameter with the photos: only then their
  // weights against one another matter.
  bool HasOtherKnowledge() const {
    const auto photos = static_cast<std::ptrdiff_t>(data_.observations.size());
    return photos > 0 &&
           (!priors_.empty() || std::find(weigher_.is_used().begin() + photos, weigher_.is_used().end(),
                                          true) != weigher_.is_used().end());
  }

  // Residuals of photos resemble one another: facets whose rows all err alike know less than they seem to.
  double PhotoDesignEffect() {
    fit_.photo_design_effect = 1;  // it is that of rows weighed as if they were independent
    Recentre();
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
      if (cluster && weights_.root_weight[i] > 0) ++size[*cluster];
    }
    double rows = 0, squares = 0;
    for (const auto& [cluster, count] : size) rows += count, squares += count * count;
    return squares > rows ? std::min(1.0, (design_effect - 1) / (squares / rows - 1)) : 1;
  }

  // Updates visibility, model error and weights at the present state.
  void Refresh(bool with_jacobian) {
    if (model_.RefreezeVisibility(fit_.state, options_.visibility_order)) solved_.reset();
    const std::vector<bool> penumbra = model_.InPenumbra();
    at_state_ = solved_ ? *std::move(solved_) : model_.Predict(fit_.state, fit_.parameters, with_jacobian);
    solved_.reset();
    const bool is_first = weights_.root_weight.size() == 0;
    for (int left = is_first && options_.start_is_near ? kMostWeighings : 1; left > 0; --left) {
      const double last_sigma = fit_.relative_sigma;
      weights_ = weigher_.Weigh(fit_.state, at_state_.value, penumbra, fit_.photo_design_effect, weights_,
                                fit_.relative_sigma);
      model_error_ratio_ = last_sigma / fit_.relative_sigma;
      fit_.relative_sigma = relaxation_.Between(last_sigma, fit_.relative_sigma);
      if (std::abs(model_error_ratio_ - 1) < kSettledWeights) break;
    }
  }

  // Returns whether a step without damping stayed where its linearisation can be trusted. Farther away, less
  // cost may be another valley.
  static bool IsNear(const LightState& before, const LightState& after) {
    constexpr double kReachM = 0.3, kFluxFactor = 3;
    if (LargestMove(before.luminaires, after.luminaires) > kReachM) return false;
    for (size_t k = 0; k < before.luminaires.size(); ++k) {
      const double ratio = after.luminaires[k].flux_lm / before.luminaires[k].flux_lm;
      if (!(ratio > 1 / kFluxFactor && ratio < kFluxFactor)) return false;
    }
    return true;
  }

  // Returns what a step does to the weighted rows.
  Eigen::VectorXd Moved(const Eigen::VectorXd& step) const {
    return weights_.Weighed(Eigen::VectorXd(at_state_.jacobian * step));
  }

  // Returns the root mean square of a step from the present weights' state in the sigmas that the rows give, the
  // photos' design effect included.
  double StepInSigmas(const Eigen::VectorXd& step) const {
    const double squares = Moved(step).squaredNorm() + step.dot(PriorInformation() * step);
    return std::sqrt(squares / static_cast<double>(std::max<Eigen::Index>(1, step.size())));
  }

  // Returns the largest move of any point of any luminaire, in m.
  static double LargestMove(const std::vector<Luminaire>& a, const std::vector<Luminaire>& b) {
    double move = 0;
    for (size_t k = 0; k < a.size(); ++k) move = std::max(move, MoveOf(a[k], b[k]));
    return move;
  }

  // Solves the normal equations. Parameters that would move by more than 0.3 m, 0.3 rad or 30 % stay: rows hardly tell
  // them (the width of a strip), and so far away the equations do not hold (IsNear).
  static Eigen::VectorXd SmallStep(Eigen::MatrixXd matrix, Eigen::VectorXd gradient) {
    constexpr double kMostStep = 0.3;
    while (true) {
      Eigen::VectorXd step = -InverseOf(matrix) * gradient;
      bool is_small = true;
      for (Eigen::Index i = 0; i < step.size(); ++i) {
        if (std::abs(step[i]) <= kMostStep) continue;
        is_small = false;
        matrix.row(i).setZero();
        matrix.col(i).setZero();
        matrix(i, i) = 1;
        gradient[i] = 0;
      }
      if (is_small) return step;
    }
  }

  // Moves to the minimum of the same problem with its discretisation's bias added to the model: one
  // Gauss-Newton step, for the bias is small. Weights stay.
  void SubtractDiscretisation() {
    bias_ = DiscretisationBias(model_, fit_.state);
    const RowMajorMatrix jacobian = weights_.Weighed(at_state_.jacobian);
    const Eigen::VectorXd step = SmallStep(jacobian.transpose() * jacobian + PriorInformation(),
                                           jacobian.transpose() * weights_.Weighed(bias_));
    Eigen::VectorXd x = PackParameters(fit_.state, fit_.parameters) + step;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Parameter& p = fit_.parameters[static_cast<size_t>(i)];
      x[i] = std::clamp(x[i], p.lower, p.upper);
    }
    fit_.state = WithParameters(fit_.state, fit_.parameters, x);
    Recentre();
    at_state_ = model_.Predict(fit_.state, fit_.parameters, true);
  }

  // Computes the covariance, the undetermined directions and the predictions of the readings.
  void Conclude() {
    fit_.predicted = at_state_.value;
    fit_.frozen = std::make_shared<FrozenLight>(model_.frozen());
    fit_.weight = weights_.weight;
    fit_.target = weights_.target;
    fit_.root_weight = weights_.root_weight;
    fit_.texture = weights_.texture.deviation;
    fit_.texture_sigma = weights_.texture.sigma;
    fit_.material_texture_sigma = weights_.texture.sigma_of_material;
    const auto readings = static_cast<Eigen::Index>(data_.readings.size());
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
    WeightedRows rows = RowsAtState();
    const IndirectError indirect = IndirectErrorOf(rows);
    AppendColumns(indirect.weighted, rows.biases);
    fit_.effective_parts =
        EffectiveParts(rows.jacobian.transpose() * rows.jacobian, smoothness_, fit_.parameters);
    const FitCovariance found = CovarianceOf(rows);
    fit_.covariance = found.covariance;
    for (const Eigen::VectorXd& direction : found.null_directions) NameNullDirection(direction);
    const Eigen::MatrixXd reading_jacobian = at_state_.jacobian.middleRows(FirstReadingRow(data_), readings);
    Eigen::VectorXd variance = (reading_jacobian * fit_.covariance * reading_jacobian.transpose()).diagonal();
    if (indirect.weighted.size() > 0) {
      // The fit follows this error where it is read, so a prediction errs by what is left of it.
      const Eigen::MatrixXd moved =
          reading_jacobian * InverseOf(rows.jacobian.transpose() * rows.jacobian + rows.prior_information) *
          (rows.jacobian.transpose() * indirect.weighted);
      const Eigen::MatrixXd left = moved - indirect.rows.middleRows(FirstReadingRow(data_), readings);
      variance += left.rowwise().squaredNorm() - moved.rowwise().squaredNorm();
    }
    fit_.reading_sigma_lx = variance.cwiseMax(0).cwiseSqrt();
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
    rows.jacobian = weights_.Weighed(at_state_.jacobian);
    rows.residual = weights_.Residual(at_state_.value + bias_);
    rows.biases = weights_.Weighed(RowMajorMatrix(SharedErrors(at_state_, bias_)));
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
    rows.spread = weights_.MeansByCluster(at_state_.value + bias_, rows.cluster);
    rows.coarse_spread = weights_.MeansByCluster(at_state_.value + bias_, rows.coarse_cluster);
    rows.alone_scatter = AloneScatter(rows);
    rows.cluster.resize(static_cast<size_t>(rows.residual.size()), -1);
    rows.coarse_cluster.resize(rows.cluster.size(), -1);
    rows.prior_information = PriorInformation();
    return rows;
  }

  // Holds what surfaces that no photo shows may lack of being even and diffuse, in a column for each mode at 1
  // sigma: in the rows' units, and weighted. Empty: no reflectance rests on their light alone.
  struct IndirectError {
    Eigen::MatrixXd rows, weighted;
  };
  IndirectError IndirectErrorOf(const WeightedRows& rows) const {
    const std::vector<bool> unseen = MaterialsWithoutPhotos(room_, data_, weights_.weight);
    const bool is_needed =
        std::any_of(fit_.parameters.begin(), fit_.parameters.end(), [&](const Parameter& p) {
          return p.kind == ParameterKind::kAlbedo && unseen[static_cast<size_t>(p.index)];
        });
    if (!is_needed || data_.indirect_is_held || room_.sparse) return {};
    const IndirectCells cells = CutIntoCells(room_, unseen);
    const RowMajorMatrix received = model_.LightReflectedBy(fit_.state, cells.surfaces);
    const Eigen::MatrixXd effect = weights_.Weighed(received);
    const auto used = static_cast<int>((weights_.root_weight.array() > 0).count());
    const Eigen::MatrixXd root = RootOfCellErrors(rows, PriorGradient(), effect, cells, used);
    return {received * root, effect * root};
  }

  static void AppendColumns(const Eigen::MatrixXd& columns, Eigen::MatrixXd& matrix) {
    if (columns.size() == 0) return;
    matrix.conservativeResize(Eigen::NoChange, matrix.cols() + columns.cols());
    matrix.rightCols(columns.cols()) = columns;
  }

  Eigen::VectorXd PriorGradient() const {
    const Eigen::VectorXd x = PackParameters(fit_.state, fit_.parameters);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
    for (const auto& [parameter, prior] : priors_)
      gradient[parameter] += (x[parameter] - prior.mean) / (prior.sigma * prior.sigma);
    for (const SmoothnessRow& row : smoothness_) {
      const double value = row.Value(x);
      for (const auto& [parameter, coefficient] : row.terms) gradient[parameter] += coefficient * value;
    }
    return gradient;
  }

  Eigen::MatrixXd PriorInformation() const {
    const auto n = static_cast<Eigen::Index>(fit_.parameters.size());
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
    for (const auto& [parameter, prior] : priors_)
      information(parameter, parameter) += 1 / (prior.sigma * prior.sigma);
    AddSmoothness(smoothness_, information);
    return information;
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
      used += weights_.root_weight[row] > 0 ? 1 : 0;
    }
    return used > 0 ? std::max(1.0, squares / used) : 1.0;
  }

  const Room& room_;
  const LightData& data_;
  const FitLuminairesOptions& options_;
  LightModel model_;
  RowWeigher weigher_;
  RowWeights weights_;
  LuminaireFit fit_;
  IndexedPriors priors_;
  std::vector<SmoothnessRow> smoothness_;
  Eigen::VectorXd bias_;  // of each row by the model's discretisation; 0 until it is subtracted
  Prediction at_state_;
  std::optional<Prediction> solved_;  // of the last solve's end, as long as the model stays the same
  double model_error_ratio_ = 0;      // of f before it was last estimated to what was estimated
  Relaxation relaxation_;             // of steps, and of f
};

}  // namespace

LuminaireFit FitLuminaires(const Room& room, const LightData& data, const LightState& start,
                           const std::vector<ParameterPrior>& priors, const FitLuminairesOptions& options) {
  return OuterLoop(room, data, start, priors, options).Run();
}

}  // namespace luxfit
