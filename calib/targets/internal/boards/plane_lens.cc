#include "calib/targets/internal/boards/plane_lens.h"

#include <ceres/ceres.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "calib/targets/internal/boards/homography.h"

namespace luxfit {
namespace {

constexpr std::size_t kLeastCorners = 16;
constexpr double kLeastGain = 0.8;  // ratio to the rms without distortion
constexpr double kHuberPx = 0.5;

struct BentCorner {
  Eigen::Vector2d place, pixel;  // place scaled to about 1, pixel in units of f about c

  template <typename T>
  bool operator()(const T* h, const T* k, T* residual) const {
    const T w = h[6] * place.x() + h[7] * place.y() + T(1);
    const T x = (h[0] * place.x() + h[1] * place.y() + h[2]) / w;
    const T y = (h[3] * place.x() + h[4] * place.y() + h[5]) / w;
    const T r2 = x * x + y * y, d = T(1) + r2 * (k[0] + r2 * k[1]);
    residual[0] = x * d - pixel.x();
    residual[1] = y * d - pixel.y();
    return true;
  }
};

double Rms(ceres::Problem& problem) {
  ceres::Problem::EvaluateOptions options;
  options.apply_loss_function = true;
  double cost = 0;
  problem.Evaluate(options, &cost, nullptr, nullptr, nullptr);
  return std::sqrt(2 * cost);
}

}  // namespace

Camera LensOfPlane(int width_px, int height_px, const std::vector<Eigen::Vector2d>& places_m,
                   const std::vector<Eigen::Vector2d>& pixels) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx_px = camera.fy_px = std::max(width_px, height_px);
  camera.cx_px = 0.5 * (width_px - 1);
  camera.cy_px = 0.5 * (height_px - 1);
  if (places_m.size() < kLeastCorners) return camera;
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& place : places_m) middle_m += place / static_cast<double>(places_m.size());
  double reach_m = 0;
  for (const Eigen::Vector2d& place : places_m) reach_m = std::max(reach_m, (place - middle_m).norm());
  std::vector<Eigen::Vector2d> from, to;
  for (std::size_t i = 0; i < places_m.size(); ++i) {
    from.emplace_back((places_m[i] - middle_m) / reach_m);
    to.emplace_back((pixels[i] - Eigen::Vector2d(camera.cx_px, camera.cy_px)) / camera.fx_px);
  }
  const auto start = FitHomography(from, to);
  if (!start || (*start)(2, 2) == 0) return camera;
  std::array<double, 8> h{};
  for (std::size_t i = 0; i < h.size(); ++i)
    h[i] = (*start)(static_cast<int>(i) / 3, static_cast<int>(i) % 3) / (*start)(2, 2);
  std::array<double, 2> k{};
  ceres::Problem problem;
  for (std::size_t i = 0; i < from.size(); ++i) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<BentCorner, 2, 8, 2>(new BentCorner{from[i], to[i]}),
        new ceres::HuberLoss(kHuberPx / camera.fx_px), h.data(), k.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 50;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  problem.SetParameterBlockConstant(k.data());
  ceres::Solve(options, &problem, &summary);
  const double straight = Rms(problem);
  problem.SetParameterBlockVariable(k.data());
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || !(Rms(problem) < kLeastGain * straight)) return camera;
  camera.distortion[0] = k[0];
  camera.distortion[1] = k[1];
  return camera;
}

Eigen::Vector2d Straightened(const Camera& lens, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray = Unproject(lens, pixel);
  if (!ray.allFinite()) return pixel;
  return Eigen::Vector2d(lens.cx_px, lens.cy_px) + lens.fx_px * ray.hnormalized();
}

}  // namespace luxfit
