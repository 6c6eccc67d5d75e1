#include "calib/targets/internal/boards/saddle.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calib/luminance/internal/plane_sample.h"
#include "calib/targets/internal/boards/homography.h"

namespace luxfit {
namespace {

constexpr int kMaxSaddleIterations = 30;
constexpr double kSaddleConvergedPx = 1e-3;
constexpr double kLeastCondition = 0.02;  // conditioning of the normal matrix: less is an edge, not a corner
constexpr double kMostAsymmetry = 0.15;   // share of the patch's variance: more is an occluder, or only noise
constexpr double kFloorPx = 0.02;         // aliasing, print, flatness
constexpr double kWindowShare = 0.9;      // of what is clear
constexpr double kMostWindowPx = 12;      // more pixels add nothing; lens and perspective bend edges

// Holds the sums over the window of w g g^T and w g g^T p, with offsets relative to its middle.
struct WindowSums {
  Eigen::Matrix2d gg = Eigen::Matrix2d::Zero();
  Eigen::Vector2d ggp = Eigen::Vector2d::Zero();
};

// Evaluates a patch one pixel wider than the window on each side.
class Window {
 public:
  Window(const Eigen::MatrixXd& patch, int half) : patch_(patch), half_(half) {}

  WindowSums Sums() const {
    WindowSums normal;
    ForEach([&](const Eigen::Vector2d& p, const Eigen::Vector2d& g, double weight) {
      normal.gg += weight * g * g.transpose();
      normal.ggp += weight * g * g.dot(p);
    });
    return normal;
  }

  // Returns the covariance of ggp under white noise of standard deviation 1 in every pixel of the patch.
  Eigen::Matrix2d NoiseOfSums() const {
    Eigen::MatrixXd d_x = Eigen::MatrixXd::Zero(patch_.rows(), patch_.cols()), d_y = d_x;
    ForEach([&](const Eigen::Vector2d& p, const Eigen::Vector2d& g, double weight) {
      // d ggp / d g; each gradient involves four pixels.
      const Eigen::Matrix2d d_g = weight * (g.dot(p) * Eigen::Matrix2d::Identity() + g * p.transpose());
      const Eigen::Index row = static_cast<Eigen::Index>(p.y()) + half_ + 1;
      const Eigen::Index column = static_cast<Eigen::Index>(p.x()) + half_ + 1;
      const auto add = [&](Eigen::Index v, Eigen::Index u, const Eigen::Vector2d& d) {
        d_x(v, u) += d.x();
        d_y(v, u) += d.y();
      };
      add(row, column + 1, d_g.col(0));
      add(row, column - 1, -d_g.col(0));
      add(row + 1, column, d_g.col(1));
      add(row - 1, column, -d_g.col(1));
    });
    Eigen::Matrix2d covariance;
    covariance(0, 0) = d_x.squaredNorm();
    covariance(1, 1) = d_y.squaredNorm();
    covariance(0, 1) = covariance(1, 0) = d_x.cwiseProduct(d_y).sum();
    return covariance;
  }

  double Variance() const { return (patch_.array() - patch_.mean()).square().mean(); }

  // Returns the variance of a pixel about the picture that looks the same turned by 180 degrees, as a saddle
  // does.
  double Asymmetry() const {
    const Eigen::MatrixXd difference = patch_ - patch_.reverse();
    return difference.squaredNorm() / (2 * static_cast<double>(difference.size()));
  }

 private:
  template <typename Use>
  void ForEach(const Use& use) const {
    for (int j = -half_; j <= half_; ++j) {
      for (int i = -half_; i <= half_; ++i) {
        const Eigen::Index row = j + half_ + 1, column = i + half_ + 1;
        const Eigen::Vector2d g(patch_(row, column + 1) - patch_(row, column - 1),
                                patch_(row + 1, column) - patch_(row - 1, column));
        const Eigen::Vector2d p(i, j);
        use(p, g, std::exp(-p.squaredNorm() / std::pow(half_, 2)));
      }
    }
  }

  const Eigen::MatrixXd& patch_;
  int half_;
};

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
  for (int i = 0; i < kMaxSaddleIterations && !converged; ++i) {
    if (!Holds(grey, at, half + 1)) return std::nullopt;
    const WindowSums normal = Window(Patch(grey, at, half), half).Sums();
    if (!IsCorner(normal.gg)) return std::nullopt;
    const Eigen::Vector2d step = normal.gg.inverse() * normal.ggp;
    if (!step.allFinite()) return std::nullopt;
    at += step;
    if (!((at - start).norm() <= half)) return std::nullopt;
    converged = step.norm() < kSaddleConvergedPx;
  }
  if (!converged || !Holds(grey, at, half + 1)) return std::nullopt;
  const Eigen::MatrixXd patch = Patch(grey, at, half);
  const Window window(patch, half);
  const Eigen::Matrix2d gg = window.Sums().gg;
  if (!IsCorner(gg) || !(window.Asymmetry() < kMostAsymmetry * window.Variance())) return std::nullopt;
  const Eigen::Matrix2d covariance = gg.inverse() * window.NoiseOfSums() * gg.inverse();
  const double variance = window.Asymmetry() * covariance.trace() / 2 + kFloorPx * kFloorPx;
  if (!std::isfinite(variance)) return std::nullopt;
  return Saddle{at, std::sqrt(variance)};
}

std::optional<Saddle> RefineSaddle(const ImagePlane& grey, const Eigen::Vector2d& start,
                                   const Eigen::Matrix3d& pixel_from_board, const Eigen::Vector2d& place,
                                   double clear) {
  const Eigen::Matrix2d board_from_pixel = MapJacobian(pixel_from_board, place).inverse();
  // The window is square in the photo: its corners reach furthest on the board.
  const double reach = board_from_pixel.cwiseAbs().rowwise().sum().maxCoeff();
  return RefineSaddle(grey, start, std::min(kMostWindowPx, kWindowShare * clear / reach));
}

}  // namespace luxfit
