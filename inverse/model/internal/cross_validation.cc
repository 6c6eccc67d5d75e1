#include "inverse/model/internal/cross_validation.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "inverse/model/internal/frozen_problem.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"
#include "inverse/model/internal/row_weights.h"

namespace luxfit {
namespace {

class FoldPredictor {
 public:
  FoldPredictor(const Room& room, const LightData& data, const LuminaireFit& fit,
                const std::vector<ParameterPrior>& priors, const std::vector<int>& fold_of_row)
      : fit_(fit),
        priors_(PriorsOf(fit.parameters, priors)),
        smoothness_(SmoothnessRows(fit.state, fit.parameters)),
        fold_of_row_(fold_of_row),
        model_(room, data) {
    model_.SetPatchFactor(fit.patch_factor);
    if (fit.frozen) model_.TakeOver(*fit.frozen);
    model_.RefreezeVisibility(fit.state);
    at_fit_ = {fit.state, fit.parameters, model_.Predict(fit.state, fit.parameters, true)};
    weights_ = WeightsOf(fit, room, data);
    folds_ = 1 + *std::max_element(fold_of_row_.begin(), fold_of_row_.end());
    rows_at_fit_ = RowsByFold(at_fit_);
    information_ = SumOf(rows_at_fit_).matrix.diagonal().cwiseMax(1e-300);
  }

  LeftOutPrediction Run() {
    LeftOutPrediction result;
    result.relative_sigma = fit_.relative_sigma;
    result.texture_sigma = fit_.material_texture_sigma;
    result.value = at_fit_.prediction.value;
    result.is_smooth = model_.InPenumbra();
    result.is_smooth.flip();
    for (int fold = 0; fold < folds_; ++fold) {
      const Eigen::VectorXd value = ValueWithout(fold);
      for (Eigen::Index i = 0; i < value.size(); ++i)
        if (FoldOf(i) == fold) result.value[i] = value[i];
    }
    return result;
  }

 private:
  RowWeights WeightsOf(const LuminaireFit& fit, const Room& room, const LightData& data) const {
    const TextureEstimator elements(room, data);
    const Eigen::VectorXd& value = at_fit_.prediction.value;
    // The design effect scales photos' rows as they are.
    Eigen::VectorXd own = fit.root_weight;
    own.head(FirstReadingRow(data)) *= std::sqrt(fit.photo_design_effect);
    RowWeights weights;
    weights.target = fit.target;
    weights.root_weight = fit.root_weight;
    weights.texture = {fit.texture, fit.texture_sigma, fit.material_texture_sigma};
    weights.whitening =
        WhiteningOf(model_, fit.state, elements, value, own, weights.texture, ViewErrors::kViewByView);
    weights.means =
        elements.Means(value, own.cwiseQuotient((1 + fit.texture.array()).matrix()), weights.texture);
    return weights;
  }

  // Holds a state, what it predicts, and where the fold's steps stand.
  struct Point {
    LightState state;
    std::vector<Parameter> parameters;  // tilts count from `state`
    Prediction prediction;
  };

  // Rows that follow the model's belong to no fold.
  int FoldOf(Eigen::Index row) const {
    const auto i = static_cast<size_t>(row);
    return i < fold_of_row_.size() ? fold_of_row_[i] : -1;
  }

  // Returns the squares of the rows outside of the fold, of priors and of smoothness.
  double SquaresWithout(int fold, const Eigen::VectorXd& value, const Eigen::VectorXd& x) const {
    NormalEquations known(x.size());
    AddPriors(priors_, smoothness_, x, known);
    const Eigen::VectorXd residual = weights_.Residual(value);
    double squares = known.squares;
    for (Eigen::Index i = 0; i < residual.size(); ++i)
      if (FoldOf(i) != fold) squares += residual[i] * residual[i];
    return squares;
  }

  // Returns the equations of each fold's rows, and last of those that belong to none.
  std::vector<NormalEquations> RowsByFold(const Point& at) const {
    const Eigen::VectorXd residual = weights_.Residual(at.prediction.value);
    const RowMajorMatrix jacobian = weights_.Weighed(at.prediction.jacobian);
    std::vector<std::vector<Eigen::Index>> own(static_cast<size_t>(folds_) + 1);
    for (Eigen::Index i = 0; i < residual.size(); ++i)
      own[static_cast<size_t>(FoldOf(i) < 0 ? folds_ : FoldOf(i))].push_back(i);
    std::vector<NormalEquations> by_fold(own.size(), NormalEquations(jacobian.cols()));
    tbb::parallel_for(size_t{0}, own.size(), [&](size_t f) {
      if (own[f].empty()) return;
      const Eigen::MatrixXd rows = jacobian(own[f], Eigen::all).transpose();
      by_fold[f].matrix.selfadjointView<Eigen::Lower>().rankUpdate(rows);
      by_fold[f].matrix = Eigen::MatrixXd(by_fold[f].matrix.selfadjointView<Eigen::Lower>());
      by_fold[f].gradient.noalias() += rows * residual(own[f]);
    });
    return by_fold;
  }

  // `without`: a fold; -1: none.
  static NormalEquations SumOf(const std::vector<NormalEquations>& by_fold, int without = -1) {
    NormalEquations sum(by_fold.front().gradient.size());
    for (size_t f = 0; f < by_fold.size(); ++f)
      if (static_cast<int>(f) != without) sum.Add(by_fold[f]);
    return sum;
  }

  NormalEquations EquationsWithout(int fold, const std::vector<NormalEquations>& by_fold,
                                   const Point& at) const {
    NormalEquations equations = SumOf(by_fold, fold);
    AddPriors(priors_, smoothness_, PackParameters(at.state, at.parameters), equations);
    // A direction that only the fold determines stays where it is.
    constexpr double kRidge = 1e-9;
    equations.matrix.diagonal() += kRidge * information_;
    return equations;
  }

  // Takes one step, halved until it lowers the squares. Returns the share of the expected gain that it made;
  // 0: no step lowers the squares.
  double Step(int fold, const std::vector<NormalEquations>& by_fold, Point& at) const {
    const NormalEquations equations = EquationsWithout(fold, by_fold, at);
    const Eigen::VectorXd step = -equations.matrix.ldlt().solve(equations.gradient);
    const double expected = -equations.gradient.dot(step);
    const Eigen::VectorXd x0 = PackParameters(at.state, at.parameters);
    const double before = SquaresWithout(fold, at.prediction.value, x0);
    constexpr double kSmallestStep = 1.0 / 8;
    for (double length = 1; length >= kSmallestStep; length /= 2) {
      Eigen::VectorXd x = x0 + length * step;
      for (Eigen::Index p = 0; p < x.size(); ++p) {
        const Parameter& parameter = at.parameters[static_cast<size_t>(p)];
        x[p] = std::clamp(x[p], parameter.lower, parameter.upper);
      }
      LightState state = WithParameters(at.state, at.parameters, x);
      Prediction prediction = model_.Predict(state, {}, false);
      if (!prediction.value.allFinite()) continue;
      const double gain = before - SquaresWithout(fold, prediction.value, x);
      if (gain < 0) continue;
      at = {std::move(state), at.parameters, std::move(prediction)};
      return expected > 0 ? gain / expected : 1;
    }
    return 0;
  }

  Eigen::VectorXd ValueWithout(int fold) const {
    if (fit_.parameters.empty()) return at_fit_.prediction.value;
    constexpr int kMostSteps = 5;
    constexpr double kNearlyLinear = 0.8;
    Point at = at_fit_;
    for (int i = 0; i < kMostSteps; ++i) {
      const double gained = Step(fold, i == 0 ? rows_at_fit_ : RowsByFold(at), at);
      if (gained <= 0 || gained > kNearlyLinear) break;
      at.parameters = Recentred(at.parameters, at.state);
      at.prediction = model_.Predict(at.state, at.parameters, true);
    }
    return at.prediction.value;
  }

  const LuminaireFit& fit_;
  const IndexedPriors priors_;
  const std::vector<SmoothnessRow> smoothness_;
  const std::vector<int>& fold_of_row_;
  LightModel model_;
  RowWeights weights_;
  int folds_ = 0;
  Point at_fit_;
  std::vector<NormalEquations> rows_at_fit_;  // without priors
  Eigen::VectorXd information_;               // diagonal of the whole fit's matrix
};

}  // namespace

LeftOutPrediction PredictLeftOut(const Room& room, const LightData& data, const LuminaireFit& fit,
                                 const std::vector<ParameterPrior>& priors,
                                 const std::vector<int>& fold_of_row) {
  return FoldPredictor(room, data, fit, priors, fold_of_row).Run();
}

}  // namespace luxfit
