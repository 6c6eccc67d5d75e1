#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/luminance/internal/response_levels.h"
#include "calib/luminance/response.h"

namespace luxfit {
namespace {

// Rounds of reweighting: the weights need the slope of the curve that they produce.
constexpr int kDebevecRounds = 3;

// Returns the paper's hat, 1 at half scale and 0 at both ends: the weight of the first round.
double Hat(double counts, double full_scale_counts) {
  return 1 - std::abs(2 * counts / full_scale_counts - 1);
}

// Returns the inverse variance of g for noise of one count everywhere, from the curve's slope over some
// knots.
Eigen::VectorXd InverseVariance(const Eigen::VectorXd& curve) {
  constexpr Eigen::Index kReach = 4;
  Eigen::VectorXd weight(kResponseLevels);
  for (Eigen::Index k = 0; k < kResponseLevels; ++k) {
    const Eigen::Index below = std::max<Eigen::Index>(0, k - kReach);
    const Eigen::Index above = std::min(kResponseLevels - 1, k + kReach);
    const double slope = (curve[above] - curve[below]) / static_cast<double>(above - below);
    weight[k] = 1 / (slope * slope);
  }
  return weight / weight.maxCoeff();
}

struct NormalEquations {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kResponseLevels, kResponseLevels);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kResponseLevels);
  double weight = 0;
};

// Adds one pixel's rows with its ln E eliminated: each row keeps its difference from the rows' weighted mean.
void AddPixel(const Eigen::RowVectorXd& counts, const Eigen::VectorXd& log_exposure,
              const Eigen::VectorXd& weight_of_level, const ResponseOptions& options,
              NormalEquations& normal) {
  struct Row {
    LevelPosition at;
    double log_time, weight;
  };
  std::vector<Row> rows;
  rows.reserve(static_cast<size_t>(counts.size()));
  double weight_sum = 0;
  for (Eigen::Index j = 0; j < counts.size(); ++j) {
    if (!IsInRange(counts[j], options)) continue;
    const LevelPosition at = PositionOf(counts[j], options.full_scale_counts);
    const double weight =
        (1 - at.share) * weight_of_level[at.below] + at.share * weight_of_level[at.below + 1];
    rows.push_back({at, log_exposure[j], weight});
    weight_sum += rows.back().weight;
  }
  if (rows.size() < 2) return;
  normal.weight += weight_sum;
  const auto add = [&](const LevelPosition& p, const LevelPosition& q, double weight) {
    normal.matrix(p.below, q.below) += weight * (1 - p.share) * (1 - q.share);
    normal.matrix(p.below, q.below + 1) += weight * (1 - p.share) * q.share;
    normal.matrix(p.below + 1, q.below) += weight * p.share * (1 - q.share);
    normal.matrix(p.below + 1, q.below + 1) += weight * p.share * q.share;
  };
  double mean_time = 0;
  for (const Row& row : rows) mean_time += row.weight / weight_sum * row.log_time;
  for (const Row& row : rows) {
    add(row.at, row.at, row.weight);
    for (const Row& other : rows) add(row.at, other.at, -row.weight * other.weight / weight_sum);
    const double right = row.weight * (row.log_time - mean_time);
    normal.right[row.at.below] += right * (1 - row.at.share);
    normal.right[row.at.below + 1] += right * row.at.share;
  }
}

// Adds lambda times the integral of the curve's squared second derivative against the logarithm of counts, in
// which every power law is straight.
void AddSmoothing(double lambda, NormalEquations& normal) {
  const auto position = [](Eigen::Index k) { return std::log(static_cast<double>(k) + 0.5); };
  for (Eigen::Index k = 1; k + 1 < kResponseLevels; ++k) {
    const double before = position(k) - position(k - 1), after = position(k + 1) - position(k);
    const double span = (before + after) / 2;
    const Eigen::RowVector3d second(1 / before, -1 / before - 1 / after, 1 / after);
    normal.matrix.block<3, 3>(k - 1, k - 1) += lambda / span * second.transpose() * second;
  }
}

// Solves, holding increments that came out negative at the least step. Each round holds more, so it ends.
Eigen::VectorXd SolveMonotone(const NormalEquations& normal) {
  // Knots that a held step joins are one unknown plus a constant.
  std::vector<bool> held(static_cast<size_t>(kResponseLevels), false);
  Eigen::VectorXd curve(kResponseLevels);
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<Eigen::Index> unknown_of(static_cast<size_t>(kResponseLevels));
    Eigen::VectorXd offset = Eigen::VectorXd::Zero(kResponseLevels);
    Eigen::Index unknowns = 0;
    for (Eigen::Index k = 0; k < kResponseLevels; ++k) {
      const size_t i = static_cast<size_t>(k);
      if (k > 0 && held[i]) {
        offset[k] = offset[k - 1] + kLeastLogStep;
      } else {
        ++unknowns;
      }
      unknown_of[i] = unknowns - 1;
    }
    Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    const Eigen::VectorXd full_right = normal.right - normal.matrix * offset;
    for (Eigen::Index k = 0; k < kResponseLevels; ++k) {
      const Eigen::Index row = unknown_of[static_cast<size_t>(k)];
      right[row] += full_right[k];
      for (Eigen::Index m = 0; m < kResponseLevels; ++m)
        reduced(row, unknown_of[static_cast<size_t>(m)]) += normal.matrix(k, m);
    }
    // Gauge: a common constant is free, so the sum of the unknowns is held.
    reduced.array() += normal.weight / static_cast<double>(kResponseLevels * kResponseLevels);
    // LLT, which is blocked, is several times as fast; LDLT serves where rounding makes the matrix
    // indefinite.
    const Eigen::LLT<Eigen::MatrixXd> fast(reduced);
    const Eigen::VectorXd solution = fast.info() == Eigen::Success
                                         ? Eigen::VectorXd(fast.solve(right))
                                         : Eigen::VectorXd(reduced.ldlt().solve(right));
    for (Eigen::Index k = 0; k < kResponseLevels; ++k)
      curve[k] = solution[unknown_of[static_cast<size_t>(k)]] + offset[k];
    for (Eigen::Index k = 1; k < kResponseLevels; ++k) {
      if (held[static_cast<size_t>(k)] || curve[k] - curve[k - 1] >= kLeastLogStep) continue;
      held[static_cast<size_t>(k)] = changed = true;
    }
  }
  return curve;
}

Eigen::VectorXd SolveChannel(const std::vector<BracketSamples>& brackets, size_t channel,
                             const Eigen::VectorXd& weight_of_level, const ResponseOptions& options,
                             double smoothing) {
  NormalEquations normal;
  for (const BracketSamples& bracket : brackets) {
    const Eigen::VectorXd log_exposure = bracket.exposure_s.array().log();
    for (Eigen::Index i = 0; i < bracket.counts[channel].rows(); ++i)
      AddPixel(bracket.counts[channel].row(i), log_exposure, weight_of_level, options, normal);
  }
  normal.weight = std::max(normal.weight, 1e-9);
  AddSmoothing(smoothing * normal.weight / static_cast<double>(kResponseLevels), normal);
  return SolveMonotone(normal);
}

}  // namespace

CameraResponse SolveDebevec(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                            double smoothing) {
  CheckSamples(brackets);
  std::array<Eigen::VectorXd, 3> curves;
  for (size_t c = 0; c < 3; ++c) {
    Eigen::VectorXd weight_of_level(kResponseLevels);
    for (Eigen::Index k = 0; k < kResponseLevels; ++k)
      weight_of_level[k] = std::pow(Hat(static_cast<double>(k), kResponseLevels - 1), 2);
    for (int round = 0; round < kDebevecRounds; ++round) {
      curves[c] = SolveChannel(brackets, c, weight_of_level, options, smoothing);
      weight_of_level = InverseVariance(curves[c]);
    }
  }
  return ResponseOf(std::move(curves), options.full_scale_counts);
}

}  // namespace luxfit
