#include "inverse/model/internal/search/group_equations.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/model/internal/search/nonnegative_least_squares.h"

namespace luxfit {
namespace {

// No surface reflects more than 95 % of its light. Without the bound, direct light on one material is taken for a reflectance of 1.3
// or 3 where that explains a little more of what the mesh lacks.
constexpr double kLeastInverseAlbedo = 1 / 0.95;

// Returns the error of light, 10 %; `floor`: the mean of what is measured, in the same unit.
double SigmaOf(double light, double floor) { return 0.1 * light + 0.02 * floor; }

double MedianSize(const Eigen::VectorXd& values) {
  const Eigen::VectorXd sizes = values.cwiseAbs();
  return Quantile({sizes.begin(), sizes.end()}, 0.5);
}

}  // namespace

GroupEquations::GroupEquations(const GroupedLight& light, int group) {
  for (size_t i = 0; i < light.places.size(); ++i) {
    const double value = light.value(static_cast<Eigen::Index>(i), group);
    if (std::isfinite(value) && value > 0) rows_.push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<int> material;
  material.reserve(rows_.size());
  for (const Eigen::Index i : rows_) material.push_back(light.material[static_cast<size_t>(i)]);
  const std::set<int> materials(material.begin(), material.end());
  materials_.assign(materials.begin(), materials.end());
  value_ = light.value(rows_, group);
  indirect_ = light.indirect(rows_, group);
  SetUp(material);
}

void GroupEquations::SetUp(const std::vector<int>& material) {
  const auto n = static_cast<Eigen::Index>(rows_.size());
  const double mean = n > 0 ? value_.mean() : 0;
  others_ = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(materials_.size()));
  column_.resize(rows_.size());
  target_.resize(n);
  Eigen::VectorXd sigma(n);
  for (size_t m = 0; m < materials_.size(); ++m) {
    // Where no direct light falls, Y / I is the albedo. The darkest tenth of a material gives it roughly.
    std::vector<double> albedo;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (material[static_cast<size_t>(i)] == materials_[m] && indirect_[i] > 0)
        albedo.push_back(value_[i] / indirect_[i]);
    }
    double white = 1;
    if (!albedo.empty()) white = 1 / std::clamp(Quantile(std::move(albedo), 0.1), 0.05, 1.0);
    const bool is_reading = materials_[m] < 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (material[static_cast<size_t>(i)] != materials_[m]) continue;
      column_[static_cast<size_t>(i)] = static_cast<Eigen::Index>(m);
      sigma[i] = SigmaOf(std::max(white * value_[i], indirect_[i]), white * mean);
      target_[i] = is_reading ? value_[i] : kLeastInverseAlbedo * value_[i] - indirect_[i];
      others_(i, static_cast<Eigen::Index>(m)) = is_reading ? 1 : -value_[i];
      if (!is_reading && white * value_[i] > 2 * indirect_[i]) lit_.push_back(i);
    }
  }
  root_weight_ = Eigen::VectorXd::Ones(n);
  MultiplyWeights(sigma.cwiseInverse());
}

void GroupEquations::MultiplyWeights(const Eigen::VectorXd& by) {
  others_ = by.asDiagonal() * others_;
  target_ = by.cwiseProduct(target_);
  root_weight_ = by.cwiseProduct(root_weight_);
}

LitPlace GroupEquations::Weighted(const LitPlace& place) const {
  LitPlace weighted;
  weighted.lx_per_cd = place.lx_per_cd(rows_).cwiseProduct(root_weight_.cast<float>());
  weighted.rays = place.rays(rows_, Eigen::all);
  for (const LitPlace& other : place.along) weighted.along.push_back(Weighted(other));
  return weighted;
}

void GroupEquations::Reweigh(const Eigen::MatrixXd& sources) {
  constexpr int kRounds = 30;
  constexpr double kSettled = 1e-3;  // relative, of the strengths
  if (rows_.empty()) return;
  const Eigen::MatrixXd light = root_weight_.cwiseInverse().asDiagonal() * sources;
  Solution solution = Solve(sources).solution;
  if (!AreReadings() && light.cols() > 0) solution = BestScaled(light, std::move(solution));
  for (int round = 0; round < kRounds; ++round) {
    const Residuals left = ResidualsOf(light * solution.strength, solution.other);
    MultiplyWeights(RobustWeights(left).cwiseQuotient(root_weight_));
    Solution next = Solve(root_weight_.asDiagonal() * light).solution;
    const bool is_settled = (next.strength - solution.strength).norm() <= kSettled * next.strength.norm();
    solution = std::move(next);
    if (is_settled) return;
  }
}

GroupEquations::Residuals GroupEquations::ResidualsOf(const Eigen::VectorXd& direct,
                                                      const Eigen::VectorXd& other) const {
  const auto n = static_cast<Eigen::Index>(rows_.size());
  const double mean = value_.mean();
  Residuals left{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index m = column_[static_cast<size_t>(i)];
    const double white = AreReadings() ? 1 : other[m];
    const double measured = white * value_[i];
    const double modelled = direct[i] + (AreReadings() ? other[m] : indirect_[i]);
    left.sigma[i] = SigmaOf(std::max(measured, modelled), white * mean);
    left.value[i] = (measured - modelled) / left.sigma[i];
  }
  return left;
}

Eigen::VectorXd GroupEquations::RobustWeights(const Residuals& left) const {
  const double sigma = std::max(MedianSize(left.value) / 0.6745, 1e-6);
  Eigen::VectorXd weight(left.value.size());
  for (Eigen::Index i = 0; i < weight.size(); ++i) {
    const bool is_dark = !AreReadings() && left.value[i] < 0;
    const double r = left.value[i] / (is_dark ? 2 * sigma : 3 * sigma);
    weight[i] = (is_dark ? 1 / (1 + r * r) : 1 / std::sqrt(1 + r * r)) / left.sigma[i];
  }
  return weight;
}

GroupEquations::Solution GroupEquations::BestScaled(const Eigen::MatrixXd& light, Solution best) const {
  double least = MedianSize(ResidualsOf(light * best.strength, best.other).value);
  Eigen::VectorXd unit = best.strength;
  if (!(unit.sum() > 0)) unit.setOnes();
  const Eigen::VectorXd direct_of_unit = light * unit;
  if (!(direct_of_unit.sum() > 0)) return best;
  for (double share = 0.25; share <= 16; share *= 2) {  // direct light over indirect, in the mean
    const double factor = share * indirect_.sum() / direct_of_unit.sum();
    const Eigen::VectorXd direct = factor * direct_of_unit;
    Eigen::VectorXd other(others_.cols());
    for (Eigen::Index m = 0; m < other.size(); ++m) {
      std::vector<double> inverse_albedo;
      for (Eigen::Index i = 0; i < direct.size(); ++i)
        if (column_[static_cast<size_t>(i)] == m)
          inverse_albedo.push_back((indirect_[i] + direct[i]) / value_[i]);
      other[m] = std::max(kLeastInverseAlbedo, Quantile(std::move(inverse_albedo), 0.5));
    }
    const double median = MedianSize(ResidualsOf(direct, other).value);
    if (median >= least) continue;
    least = median;
    best.strength = factor * unit;
    best.other = std::move(other);
  }
  return best;
}

GroupEquations::Base GroupEquations::Solve(const Eigen::MatrixXd& sources) const {
  Base base;
  base.columns.resize(others_.rows(), others_.cols() + sources.cols());
  base.columns << others_, sources;
  base.gram = base.columns.transpose() * base.columns;
  base.moment = base.columns.transpose() * target_;
  const Eigen::VectorXd x = SolveNonNegative(base.gram, base.moment);
  base.solution = SolutionOf(x, base.gram, base.moment);
  base.residual = target_ - base.columns * x;
  std::vector<Eigen::Index> positive;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (x[i] > 0) positive.push_back(i);
  }
  if (positive.empty()) {
    base.positive.resize(others_.rows(), 0);
    return base;
  }
  const Eigen::MatrixXd spanned = base.columns(Eigen::all, positive);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(spanned);
  base.positive = (qr.householderQ() * Eigen::MatrixXd::Identity(spanned.rows(), qr.rank())).cast<float>();
  return base;
}

double GroupEquations::MeanSquare(const Eigen::VectorXd& residual) const {
  constexpr size_t kFewest = 20;
  const double of_all = residual.squaredNorm() / static_cast<double>(residual.size());
  if (lit_.size() < kFewest) return of_all;
  return std::max(of_all, residual(lit_).squaredNorm() / static_cast<double>(lit_.size()));
}

GroupEquations::Solution GroupEquations::SolveWith(const Base& base, const Eigen::VectorXd& source) const {
  const Eigen::Index n = base.gram.rows();
  Eigen::MatrixXd gram(n + 1, n + 1);
  const Eigen::VectorXd cross = base.columns.transpose() * source;
  gram << base.gram, cross, cross.transpose(), source.squaredNorm();
  Eigen::VectorXd moment(n + 1);
  moment << base.moment, source.dot(target_);
  return SolutionOf(SolveNonNegative(gram, moment), gram, moment);
}

Eigen::VectorXf GroupEquations::Gains(const Base& base, const Eigen::MatrixXf& sources) {
  const Eigen::ArrayXf pull = (sources.transpose() * base.residual.cast<float>()).array();
  const Eigen::ArrayXf own = sources.colwise().squaredNorm().transpose().array();
  const Eigen::MatrixXf shared = base.positive.transpose() * sources;
  constexpr float kRounding = 1e-5F;  // of own, where a source repeats others
  const Eigen::ArrayXf apart =
      (own - shared.colwise().squaredNorm().transpose().array()).max(kRounding * own);
  return (pull > 0).select(pull.square() / apart, 0);
}

GroupEquations::Solution GroupEquations::SolutionOf(const Eigen::VectorXd& x, const Eigen::MatrixXd& gram,
                                                    const Eigen::VectorXd& moment) const {
  const double cost = target_.squaredNorm() - 2 * x.dot(moment) + x.dot(gram * x);
  Solution solution{x.tail(x.size() - others_.cols()), x.head(others_.cols()), cost};
  for (size_t m = 0; m < materials_.size(); ++m)
    if (materials_[m] >= 0) solution.other[static_cast<Eigen::Index>(m)] += kLeastInverseAlbedo;
  return solution;
}

}  // namespace luxfit
