#include "inverse/model/internal/search/group_equations.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/model/internal/search/nonnegative_least_squares.h"

namespace luxfit {

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
  SetUp(material, light.value(rows_, group), light.indirect(rows_, group));
}

void GroupEquations::SetUp(const std::vector<int>& material, const Eigen::VectorXd& value,
                           const Eigen::VectorXd& indirect) {
  const auto n = static_cast<Eigen::Index>(rows_.size());
  const double mean = n > 0 ? value.mean() : 0;
  others_ = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(materials_.size()));
  root_weight_.resize(n);
  target_.resize(n);
  for (size_t m = 0; m < materials_.size(); ++m) {
    // Where no direct light falls, Y / I is the albedo. The darkest tenth of a material gives it roughly.
    std::vector<double> albedo;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (material[static_cast<size_t>(i)] == materials_[m] && indirect[i] > 0)
        albedo.push_back(value[i] / indirect[i]);
    }
    double white = 1;
    if (!albedo.empty()) white = 1 / std::clamp(Quantile(std::move(albedo), 0.1), 0.05, 1.0);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (material[static_cast<size_t>(i)] != materials_[m]) continue;
      const bool is_reading = materials_[m] < 0;
      const double sigma = (is_reading ? 1 : white) * (0.1 * value[i] + 0.02 * mean);
      root_weight_[i] = 1 / sigma;
      target_[i] = (is_reading ? value[i] : -indirect[i]) / sigma;
      others_(i, static_cast<Eigen::Index>(m)) = (is_reading ? 1 : -value[i]) / sigma;
      if (!is_reading && white * value[i] > 2 * indirect[i]) lit_.push_back(i);
    }
  }
}

LitPlace GroupEquations::Weighted(const LitPlace& place) const {
  LitPlace weighted;
  weighted.lx_per_cd = place.lx_per_cd(rows_).cwiseProduct(root_weight_.cast<float>());
  weighted.rays = place.rays(rows_, Eigen::all);
  for (const LitPlace& other : place.along) weighted.along.push_back(Weighted(other));
  return weighted;
}

void GroupEquations::Reweigh(const Eigen::MatrixXd& sources) {
  const Eigen::VectorXd residual = Solve(sources).residual;
  std::vector<double> sizes(residual.begin(), residual.end());
  for (double& size : sizes) size = std::abs(size);
  constexpr double kSigmas = 3;
  const double scale = kSigmas * std::max(Quantile(std::move(sizes), 0.5) / 0.6745, 1e-6);
  const Eigen::VectorXd down = (1 + (residual / scale).array().square()).rsqrt();
  others_ = down.asDiagonal() * others_;
  target_ = down.cwiseProduct(target_);
  root_weight_ = down.cwiseProduct(root_weight_);
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
  return {x.tail(x.size() - others_.cols()), x.head(others_.cols()), cost};
}

}  // namespace luxfit
