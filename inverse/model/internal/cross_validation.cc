#include "inverse/model/internal/cross_validation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "inverse/model/internal/frozen_problem.h"
#include "inverse/model/internal/light_model.h"
#include "inverse/model/internal/part_smoothness.h"
#include "inverse/model/internal/weights/row_weights.h"

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
    const RowMajorMatrix jacobian = weights_.Weighed(at_fit_.prediction.jacobian);
    information_ = jacobian.colwise().squaredNorm().transpose().cwiseMax(1e-300);
    const Eigen::VectorXd residual = weights_.Residual(at_fit_.prediction.value);
    for (int fold = -1; fold < FoldCount() && !fit.parameters.empty(); ++fold)
      of_fold_.push_back(SumOf(jacobian, residual, [fold](int of_row) { return of_row == fold; }));
  }

  LeftOutPrediction Run() {
    LeftOutPrediction result;
    result.relative_sigma = fit_.relative_sigma;
    result.texture_sigma = fit_.material_texture_sigma;
    result.value = at_fit_.prediction.value;
    result.is_smooth = model_.InPenumbra();
    result.is_smooth.flip();
    for (int fold = 0; fold < FoldCount(); ++fold) {
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

  int FoldCount() const { return 1 + *std::max_element(fold_of_row_.begin(), fold_of_row_.end()); }

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

  // Sums the rows of those folds; of the matrix, only the lower triangle is filled.
  template <typename IsTaken>
  NormalEquations SumOf(const RowMajorMatrix& jacobian, const Eigen::VectorXd& residual,
                        const IsTaken& is_taken) const {
    NormalEquations equations(jacobian.cols());
    std::vector<Eigen::Index> taken;
    for (Eigen::Index i = 0; i < residual.size(); ++i)
      if (is_taken(FoldOf(i))) taken.push_back(i);
    if (taken.empty()) return equations;
    const Eigen::MatrixXd rows = jacobian(taken, Eigen::all).transpose();
    equations.matrix.selfadjointView<Eigen::Lower>().rankUpdate(rows);
    equations.gradient.noalias() += rows * residual(taken);
    return equations;
  }

  // Sums the rows of all other folds at a point, `is_at_fit` of the fit itself: those sums are known.
  NormalEquations SumWithout(int fold, const Point& at, bool is_at_fit) const {
    if (!is_at_fit)
      return SumOf(weights_.Weighed(at.prediction.jacobian), weights_.Residual(at.prediction.value),
                   [fold](int of_row) { return of_row != fold; });
    NormalEquations equations(information_.size());
    for (size_t i = 0; i < of_fold_.size(); ++i)
      if (static_cast<int>(i) - 1 != fold) equations.Add(of_fold_[i]);
    return equations;
  }

  NormalEquations EquationsWithout(int fold, const Point& at, bool is_at_fit) const {
    const Eigen::VectorXd x = PackParameters(at.state, at.parameters);
    NormalEquations equations = SumWithout(fold, at, is_at_fit);
    equations.matrix = Eigen::MatrixXd(equations.matrix.selfadjointView<Eigen::Lower>());
    AddPriors(priors_, smoothness_, x, equations);
    // A direction that only the fold determines stays where it is.
    constexpr double kRidge = 1e-9;
    equations.matrix.diagonal() += kRidge * information_;
    return equations;
  }

  // Takes one step, halved until it lowers the squares. Returns the share of the expected gain that it made;
  // 0: no step lowers the squares.
  double Step(int fold, Point& at, bool is_at_fit) const {
    const NormalEquations equations = EquationsWithout(fold, at, is_at_fit);
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
      const double gained = Step(fold, at, i == 0);
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
  Point at_fit_;
  Eigen::VectorXd information_;           // diagonal of the whole fit's matrix
  std::vector<NormalEquations> of_fold_;  // at the fit; first, of rows of no fold
};

}  // namespace

LeftOutPrediction PredictLeftOut(const Room& room, const LightData& data, const LuminaireFit& fit,
                                 const std::vector<ParameterPrior>& priors,
                                 const std::vector<int>& fold_of_row) {
  return FoldPredictor(room, data, fit, priors, fold_of_row).Run();
}

}  // namespace luxfit
