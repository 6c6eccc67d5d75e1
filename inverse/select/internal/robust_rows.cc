#include "inverse/select/internal/robust_rows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calib/luminance/median.h"
#include "inverse/select/internal/robust_weight.h"

namespace luxfit {
namespace {

// Rounds of least absolute residuals, then all.
constexpr int kStartRounds = 6, kAllRounds = 16;
// Noise: at least, and at the start. Values are relative, or logarithms.
constexpr double kLeastNoise = 0.002, kStartNoise = 0.01;
constexpr double kCauchySigmas = 2.5;

}  // namespace

void RobustRows::Add(const std::vector<Term>& terms, double value, double size, int group) {
  rows_.push_back({terms_.size(), terms.size(), value, size, group});
  terms_.insert(terms_.end(), terms.begin(), terms.end());
}

void RobustRows::Add(const RobustRows& rows) {
  for (Row row : rows.rows_) {
    row.first += terms_.size();
    rows_.push_back(row);
  }
  terms_.insert(terms_.end(), rows.terms_.begin(), rows.terms_.end());
}

double RobustRows::Residual(size_t row, const Eigen::VectorXd& x) const {
  double rest = rows_[row].value;
  for (const Term* t = First(row); t != Last(row); ++t) rest -= t->by * x[t->at];
  return rest / rows_[row].size;
}

double RobustRows::NoiseAt(const Eigen::VectorXd& x, int without) const {
  std::vector<double> sizes;
  sizes.reserve(rows_.size());
  for (size_t i = 0; i < rows_.size(); ++i)
    if (FoldOf(i) != without) sizes.push_back(std::abs(Residual(i, x)));
  return sizes.empty() ? kLeastNoise : std::max(kLeastNoise, kSigmaPerMad * Median(sizes));
}

Eigen::VectorXd RobustRows::Solve(double mean, double sigma, Eigen::Index unknowns, int without) const {
  const double prior = 1 / (sigma * sigma);
  Eigen::VectorXd x = Eigen::VectorXd::Constant(unknowns, mean);
  double noise = kStartNoise;
  for (int round = 0; round < kAllRounds; ++round) {
    Eigen::MatrixXd normal = Eigen::VectorXd::Constant(unknowns, prior).asDiagonal();
    Eigen::VectorXd right = Eigen::VectorXd::Constant(unknowns, prior * mean);
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (FoldOf(i) == without) continue;
      const double z = std::abs(Residual(i, x)) / noise;
      const double robust = round < kStartRounds ? 1 / std::max(1.0, z) : CauchyWeight(z, kCauchySigmas);
      AddTo(i, robust / std::pow(noise * rows_[i].size, 2), normal, right);
    }
    x = normal.ldlt().solve(right);
    noise = NoiseAt(x, without);
  }
  return x;
}

void RobustRows::AddTo(size_t row, double weight, Eigen::MatrixXd& normal, Eigen::VectorXd& right) const {
  for (const Term* a = First(row); a != Last(row); ++a) {
    right[a->at] += weight * a->by * rows_[row].value;
    for (const Term* b = First(row); b != Last(row); ++b) normal(a->at, b->at) += weight * a->by * b->by;
  }
}

}  // namespace luxfit
