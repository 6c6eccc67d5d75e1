#include "inverse/albedo/internal/pixel_elimination.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

namespace luxfit {
namespace {

constexpr Eigen::Index kGrain = 256;  // pixels summed together: the same sums on any number of cores
using PixelRange = tbb::blocked_range<Eigen::Index>;

bool TakesPart(const StereoState& state, Eigen::Index pixel) { return state.b.col(pixel).squaredNorm() > 0; }

// A pixel with few lights must not jump to another branch.
Eigen::Vector3d ShortStep(const Eigen::Vector3d& step, const Eigen::Vector3d& b) {
  constexpr double kLongest = 0.4;
  const double longest = kLongest * b.norm();
  return step.norm() > longest ? Eigen::Vector3d(step * (longest / step.norm())) : step;
}

// Lowers one pixel's squares until a further step would hardly do so, and takes that last step unseen: the
// linearized rows say what it brings. Changes b of that pixel alone. Returns the rows before the last step.
PixelRows SolvePixel(const StereoProblem& problem, const Eigen::MatrixXd& weight, StereoState& state,
                     Eigen::Index pixel) {
  constexpr int kMaxSteps = 10;
  constexpr double kSmallShare = 1e-3, kSmallSquares = 1e-8;
  constexpr double kFirstDamping = 1e-2, kDampingFactor = 10;
  PixelRows rows(problem, weight, state, pixel);
  double damping = 0;
  for (int k = 0; k < kMaxSteps && rows.Decrement() > kSmallShare * rows.squares() + kSmallSquares; ++k) {
    const Eigen::Vector3d b = state.b.col(pixel);
    state.b.col(pixel) = b + ShortStep(rows.Step(damping), b);
    PixelRows next(problem, weight, state, pixel);
    if (next.squares() < rows.squares()) {
      rows = std::move(next);
      damping = damping > kFirstDamping ? damping / kDampingFactor : 0;
    } else {
      state.b.col(pixel) = b;
      damping = std::max(kFirstDamping, kDampingFactor * damping);
    }
  }
  const Eigen::Vector3d b = state.b.col(pixel);
  state.b.col(pixel) = b + ShortStep(rows.Step(0), b);
  return rows;
}

}  // namespace

PixelRows::PixelRows(const StereoProblem& problem, const Eigen::MatrixXd& weight, const StereoState& state,
                     Eigen::Index pixel) {
  const StereoPixel at(state, pixel);
  rows_.reserve(static_cast<size_t>(problem.value.rows()));
  for (Eigen::Index k = 0; k < problem.value.rows(); ++k) {
    if (!problem.used(k, pixel)) continue;
    rows_.push_back({k, weight(k, pixel), 0, at.Term(k)});
    Row& row = rows_.back();
    row.residual = row.term.value - problem.value(k, pixel);
    information_ += row.weight * row.term.d_b * row.term.d_b.transpose();
    gradient_ += row.weight * row.residual * row.term.d_b;
    squares_ += row.weight * row.residual * row.residual;
  }
  Eigen::Matrix3d regular = information_;
  regular.diagonal().array() += 1e-12 * (1 + information_.trace());
  covariance_ = regular.inverse();
}

Eigen::Vector3d PixelRows::Step(double damping) const {
  if (damping == 0) return -covariance_ * gradient_;
  Eigen::Matrix3d damped = information_;
  damped.diagonal() *= 1 + damping;
  damped.diagonal().array() += 1e-12 * (1 + information_.trace());
  return -damped.inverse() * gradient_;
}

Eigen::Matrix3Xd PixelRows::Coupling(const SharedUnknowns& shared) const {
  Eigen::Matrix3Xd coupling = Eigen::Matrix3Xd::Zero(3, shared.count());
  for (const Row& row : rows_) {
    shared.Row(row.term, row.image, [&](Eigen::Index column, double slope) {
      coupling.col(column) += row.weight * slope * row.term.d_b;
    });
  }
  return coupling;
}

void PixelRows::AddReduced(const SharedUnknowns& shared, NormalEquations& equations) const {
  equations.squares += squares_ - Decrement();
  if (shared.count() == 0) return;
  for (const Row& row : rows_) {
    shared.Row(row.term, row.image, [&](Eigen::Index column, double slope) {
      equations.gradient[column] += row.weight * row.residual * slope;
      shared.Row(row.term, row.image, [&](Eigen::Index other, double other_slope) {
        equations.matrix(column, other) += row.weight * slope * other_slope;
      });
    });
  }
  const Eigen::Matrix3Xd coupling = Coupling(shared);
  const Eigen::Matrix3Xd by_shared = covariance_ * coupling;
  equations.matrix.noalias() -= coupling.transpose() * by_shared;
  equations.gradient.noalias() -= by_shared.transpose() * gradient_;
}

void PixelRows::AddScores(const SharedUnknowns& shared, Eigen::MatrixXd& scores) const {
  const Eigen::Matrix3Xd by_shared = covariance_ * Coupling(shared);
  for (const Row& row : rows_) {
    const double pull = row.weight * row.residual;
    shared.Row(row.term, row.image,
               [&](Eigen::Index column, double slope) { scores(column, row.image) += pull * slope; });
    scores.col(row.image) -= pull * by_shared.transpose() * row.term.d_b;
  }
}

PixelElimination::PixelElimination(const StereoProblem& problem, const Eigen::MatrixXd& weight,
                                   const StereoState& state)
    : problem_(problem), weight_(weight), state_(state), shared_(problem, state) {}

NormalEquations PixelElimination::EquationsAt(const Eigen::VectorXd& x) {
  known_ = shared_.Applied(state_, x);
  known_at_ = x;
  const SharedUnknowns here = shared_.At(x);
  NormalEquations equations = tbb::parallel_deterministic_reduce(
      PixelRange(0, known_.b.cols(), kGrain), NormalEquations(x.size()),
      [&](const PixelRange& range, NormalEquations sum) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
          if (TakesPart(known_, i)) SolvePixel(problem_, weight_, known_, i).AddReduced(here, sum);
        }
        return sum;
      },
      [](NormalEquations a, const NormalEquations& b) {
        a.Add(b);
        return a;
      });
  shared_.AddPriors(x, equations);
  return equations;
}

StereoState PixelElimination::StateAt(const Eigen::VectorXd& x) {
  if (!known_at_ || *known_at_ != x) EquationsAt(x);
  return known_;
}

StereoEquations ReducedEquations(const StereoProblem& problem, const Eigen::MatrixXd& weight,
                                 const StereoState& state) {
  const SharedUnknowns shared(problem, state);
  const StereoEquations none{NormalEquations(shared.count()),
                             Eigen::MatrixXd::Zero(shared.count(), problem.value.rows())};
  StereoEquations equations = tbb::parallel_deterministic_reduce(
      PixelRange(0, state.b.cols(), kGrain), none,
      [&](const PixelRange& range, StereoEquations sum) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
          if (!TakesPart(state, i)) continue;
          const PixelRows rows(problem, weight, state, i);
          rows.AddReduced(shared, sum.reduced);
          rows.AddScores(shared, sum.scores);
        }
        return sum;
      },
      [](StereoEquations a, const StereoEquations& b) {
        a.reduced.Add(b.reduced);
        a.scores += b.scores;
        return a;
      });
  shared.AddPriors(Eigen::VectorXd::Zero(shared.count()), equations.reduced);
  return equations;
}

}  // namespace luxfit
