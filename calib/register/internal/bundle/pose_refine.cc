#include "calib/register/internal/bundle/pose_refine.h"

#include <ceres/rotation.h>
#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include "calib/lens/internal/rotation_vector.h"

namespace luxfit {
namespace {

// x: rotation vector (rad) and translation (m).
struct RayDistances {
  const std::vector<cv::Point3d>& points;
  const std::vector<cv::Point2d>& rays;

  [[nodiscard]] int NumResiduals() const { return 2 * static_cast<int>(points.size()); }

  template <typename T>
  bool operator()(const T* x, T* residuals) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const T at[3] = {T(points[i].x), T(points[i].y), T(points[i].z)};
      T seen[3];
      ceres::AngleAxisRotatePoint(x, at, seen);
      const T depth = seen[2] + x[5];
      if (depth == T(0)) return false;
      residuals[2 * i] = (seen[0] + x[3]) / depth - rays[i].x;
      residuals[2 * i + 1] = (seen[1] + x[4]) / depth - rays[i].y;
    }
    return true;
  }
};

}  // namespace

Eigen::Isometry3d RefinePose(const std::vector<cv::Point3d>& points, const std::vector<cv::Point2d>& rays,
                             const Eigen::Isometry3d& cam_from_world) {
  using Function = ceres::TinySolverAutoDiffFunction<RayDistances, Eigen::Dynamic, 6>;
  const RayDistances distances{points, rays};
  const Function function(distances);
  ceres::TinySolver<Function> solver{};
  solver.options.max_num_iterations = 20;
  solver.options.function_tolerance = 1e-12;
  Eigen::Matrix<double, 6, 1> x;
  x << RotationVectorOf(cam_from_world.linear()), cam_from_world.translation();
  const Eigen::Matrix<double, 6, 1> start = x;
  solver.Solve(function, &x);
  return x.allFinite() ? PoseOf(x.data(), x.data() + 3) : PoseOf(start.data(), start.data() + 3);
}

}  // namespace luxfit
