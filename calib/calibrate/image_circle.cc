#include "calib/calibrate/image_circle.h"

#include <algorithm>
#include <cmath>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr double kRadPerDeg = M_PI / 180;
constexpr double kWideRad = 60 * kRadPerDeg, kHemisphereRad = 90 * kRadPerDeg;
constexpr int kColumns = 96;
constexpr double kDarkShare = 0.06, kDarkestShare = 0.25, kLitShareOfRing = 0.25;
constexpr double kGamma = 2.2;

double AngleRad(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d direction = Unproject(camera, pixel);
  return std::atan2(direction.head<2>().norm(), direction.z());
}

// Tells whether the picture reaches beyond the angle at which a camera counts as wide.
bool IsWide(const Camera& camera) {
  const double right = camera.width_px - 1, bottom = camera.height_px - 1;
  for (const Eigen::Vector2d& rim :
       {Eigen::Vector2d(0, camera.cy_px), Eigen::Vector2d(right, camera.cy_px),
        Eigen::Vector2d(camera.cx_px, 0), Eigen::Vector2d(camera.cx_px, bottom)}) {
    if (AngleRad(camera, rim) > kWideRad) return true;
  }
  return false;
}

// Returns the largest distance from the centre at which the lens has an image of directions so far from its axis; 0 where
// it has none.
double RadiusOfAnglePx(const Camera& camera, double angle_rad) {
  constexpr int kAround = 8;
  double radius_px = 0;
  for (int k = 0; k < kAround; ++k) {
    const double around = 2 * M_PI * k / kAround;
    const Eigen::Vector3d direction(std::sin(angle_rad) * std::cos(around),
                                    std::sin(angle_rad) * std::sin(around), std::cos(angle_rad));
    const Eigen::Vector2d pixel = Project(camera, direction);
    if (pixel.allFinite())
      radius_px = std::max(radius_px, (pixel - Eigen::Vector2d(camera.cx_px, camera.cy_px)).norm());
  }
  return radius_px;
}

// Counts the cells of a ring, and those of them that are lit.
struct Ring {
  int cells = 0, lit = 0;
};

std::vector<Ring> RingsOf(const Camera& camera, const Eigen::MatrixXd& brightest, double width_px) {
  const std::vector<double> values(brightest.data(), brightest.data() + brightest.size());
  const double darkest = brightest.minCoeff(), bright = Quantile(values, 0.99);
  const double dark = std::min(darkest + kDarkShare * (bright - darkest), kDarkestShare * bright);
  const ImageRaster raster{camera.width_px, camera.height_px, brightest.rows(), brightest.cols()};
  std::vector<Ring> rings;
  for (Eigen::Index row = 0; row < brightest.rows(); ++row) {
    for (Eigen::Index column = 0; column < brightest.cols(); ++column) {
      const double radius_px =
          (raster.MiddleOf(row, column) - Eigen::Vector2d(camera.cx_px, camera.cy_px)).norm();
      const auto number = static_cast<std::size_t>(radius_px / width_px);
      if (number >= rings.size()) rings.resize(number + 1);
      ++rings[number].cells;
      rings[number].lit += brightest(row, column) >= dark ? 1 : 0;
    }
  }
  return rings;
}

// Returns where photos turn dark beyond a radius; infinity where they do not.
double RadiusOfLightPx(const Camera& camera, const Eigen::MatrixXd& brightest, double beyond_px) {
  const double width_px = static_cast<double>(camera.width_px) / static_cast<double>(brightest.cols());
  const std::vector<Ring> rings = RingsOf(camera, brightest, width_px);
  for (auto k = static_cast<std::size_t>(beyond_px / width_px) + 1; k < rings.size(); ++k) {
    if (rings[k].cells > 0 && rings[k].lit < kLitShareOfRing * rings[k].cells)
      return static_cast<double>(k) * width_px;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

bool ImageCircle::IsWholePicture() const { return std::isinf(radius_px); }

bool ImageCircle::Holds(const Eigen::Vector2d& pixel) const {
  return (pixel - centre_px).norm() <= radius_px;
}

Eigen::Vector2d ImageRaster::MiddleOf(Eigen::Index row, Eigen::Index column) const {
  return {(static_cast<double>(column) + 0.5) * width_px / static_cast<double>(columns) - 0.5,
          (static_cast<double>(row) + 0.5) * height_px / static_cast<double>(rows) - 0.5};
}

Eigen::MatrixXd WithinCircle(const ImageCircle& circle, int width_px, int height_px, Eigen::MatrixXd values) {
  const ImageRaster raster{width_px, height_px, values.rows(), values.cols()};
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      if (!circle.Holds(raster.MiddleOf(row, column)))
        values(row, column) = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return values;
}

Eigen::MatrixXd DisplayValues(const ImagePlane& grey_counts, double full_scale_counts, bool is_linear) {
  const Eigen::Index width = grey_counts.cols(), height = grey_counts.rows();
  const Eigen::Index columns = std::min<Eigen::Index>(kColumns, width);
  const Eigen::Index rows = std::clamp<Eigen::Index>(columns * height / width, 1, height);
  Eigen::MatrixXd values(rows, columns);
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index column = 0; column < columns; ++column) {
      const Eigen::Index y = row * height / rows, x = column * width / columns;
      const auto cell =
          grey_counts.block(y, x, (row + 1) * height / rows - y, (column + 1) * width / columns - x);
      const double share = std::max(0.0, static_cast<double>(cell.mean()) / full_scale_counts);
      values(row, column) = is_linear ? std::pow(share, 1 / kGamma) : share;
    }
  }
  return values;
}

ImageCircle CircleOf(const Camera& camera, const std::vector<Eigen::Vector2d>& corners_px,
                     const Eigen::MatrixXd& brightest) {
  ImageCircle circle;
  if (!IsWide(camera)) return circle;
  circle.centre_px = {camera.cx_px, camera.cy_px};
  double least_px = RadiusOfAnglePx(camera, kWideRad);
  for (const Eigen::Vector2d& corner : corners_px)
    least_px = std::max(least_px, (corner - circle.centre_px).norm());
  if (brightest.size() > 0) {
    circle.radius_px = RadiusOfLightPx(camera, brightest, least_px);
  } else {
    const double hemisphere_px = RadiusOfAnglePx(camera, kHemisphereRad);
    if (hemisphere_px > 0) circle.radius_px = std::max(least_px, hemisphere_px);
  }
  return circle;
}

}  // namespace luxfit
