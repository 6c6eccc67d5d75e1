#include "calib/internal/saddle.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calib/internal/plane_sample.h"

namespace luxfit {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kConvergedPx = 1e-3;
constexpr double kLeastCondition = 0.02;  // of the normal matrix: less is an edge, not a corner
// Central differences of neighbouring pixels share pixels, bilinear sampling shares more: the effective
// number of independent gradients is smaller. Measured on rendered corners under noise
// (tests/calib/saddle_test.cc).
constexpr double kShared = 1.5;
constexpr double kFloorPx = 0.02;  // aliasing, print, flatness

struct Normal {
  Eigen::Matrix2d gg = Eigen::Matrix2d::Zero();
  Eigen::Vector2d ggp = Eigen::Vector2d::Zero();
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
};

// Of the gradients about `center`; offsets are relative to it.
Normal Accumulate(const Eigen::MatrixXd& patch, int half) {
  Normal normal;
  const double width = half;
  for (int j = -half; j <= half; ++j) {
    for (int i = -half; i <= half; ++i) {
      const Eigen::Index row = j + half + 1, column = i + half + 1;
      const Eigen::Vector2d g(patch(row, column + 1) - patch(row, column - 1),
                              patch(row + 1, column) - patch(row - 1, column));
      const Eigen::Vector2d p(i, j);
      const double weight = std::exp(-p.squaredNorm() / (width * width));
      const Eigen::Matrix2d gg = g * g.transpose();
      normal.gg += weight * gg;
      normal.ggp += weight * gg * p;
      normal.scatter += std::pow(weight * g.dot(p), 2) * gg;
    }
  }
  return normal;
}

Eigen::MatrixXd Patch(const ImagePlane& grey, const Eigen::Vector2d& center, int half) {
  return Eigen::MatrixXd::NullaryExpr(2 * half + 3, 2 * half + 3, [&](Eigen::Index row, Eigen::Index column) {
    return SampleBilinear(grey, center + Eigen::Vector2d(static_cast<double>(column - half - 1),
                                                         static_cast<double>(row - half - 1)));
  });
}

bool IsCorner(const Eigen::Matrix2d& gg) {
  const double trace = gg.trace();
  return std::isfinite(trace) && trace > 0 && gg.determinant() > kLeastCondition * trace * trace;
}

}  // namespace

std::optional<Saddle> RefineSaddle(const ImagePlane& grey, const Eigen::Vector2d& start,
                                   double half_window_px) {
  const int half = static_cast<int>(std::lround(half_window_px));
  if (half < 1 || !start.allFinite()) return std::nullopt;
  Eigen::Vector2d at = start;
  bool converged = false;
  for (int i = 0; i < kMaxIterations && !converged; ++i) {
    if (!Holds(grey, at, half + 1)) return std::nullopt;
    const Normal normal = Accumulate(Patch(grey, at, half), half);
    if (!IsCorner(normal.gg)) return std::nullopt;
    const Eigen::Vector2d step = normal.gg.inverse() * normal.ggp;
    if (!step.allFinite()) return std::nullopt;
    at += step;
    if (!((at - start).norm() <= half)) return std::nullopt;
    converged = step.norm() < kConvergedPx;
  }
  if (!converged || !Holds(grey, at, half + 1)) return std::nullopt;
  const Normal normal = Accumulate(Patch(grey, at, half), half);
  if (!IsCorner(normal.gg)) return std::nullopt;
  const Eigen::Matrix2d inverse = normal.gg.inverse();
  const Eigen::Matrix2d covariance = inverse * normal.scatter * inverse;
  const double variance = kShared * kShared * covariance.trace() / 2 + kFloorPx * kFloorPx;
  if (!std::isfinite(variance)) return std::nullopt;
  return Saddle{at, std::sqrt(variance)};
}

}  // namespace luxfit
