#include "calib/targets/internal/boards/checker_corner.h"

#include <algorithm>
#include <cmath>

#include "calib/luminance/internal/plane_sample.h"
#include "calib/targets/internal/boards/homography.h"

namespace luxfit {
namespace {

constexpr double kLeastContrast = 0.1;  // relative to white: less is no ink on paper

bool HasItsColours(const ImagePlane& grey, const Eigen::Matrix3d& pixel_from_board,
                   const CheckerCorner& corner) {
  const double half = corner.clear_m / 2;
  const auto at = [&](double x, double y) {
    return SampleBilinear(grey, MapPoint(pixel_from_board, corner.place_m + Eigen::Vector2d(x, y)));
  };
  const double a = at(-half, -half), b = at(half, half), c = at(half, -half), d = at(-half, half);
  if (!std::isfinite(a + b + c + d)) return false;
  const double brightest_black = corner.is_top_left_black ? std::max(a, b) : std::max(c, d);
  const double darkest_white = corner.is_top_left_black ? std::min(c, d) : std::min(a, b);
  return darkest_white - brightest_black > kLeastContrast * darkest_white;
}

}  // namespace

std::optional<Saddle> MeasureCheckerCorner(const ImagePlane& grey, const Eigen::Matrix3d& pixel_from_board,
                                           const CheckerCorner& corner) {
  const Eigen::Vector2d start = MapPoint(pixel_from_board, corner.place_m);
  if (!start.allFinite() || !HasItsColours(grey, pixel_from_board, corner)) return std::nullopt;
  return RefineSaddle(grey, start, pixel_from_board, corner.place_m, corner.clear_m);
}

}  // namespace luxfit
