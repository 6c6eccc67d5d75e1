#include "calib/luminance/internal/plane_sample.h"

#include <algorithm>
#include <limits>

namespace luxfit {

bool Holds(const ImagePlane& plane, const Eigen::Vector2d& pixel, double half_width_px) {
  return pixel.minCoeff() >= half_width_px &&
         pixel.x() <= static_cast<double>(plane.cols() - 1) - half_width_px &&
         pixel.y() <= static_cast<double>(plane.rows() - 1) - half_width_px;
}

double SampleBilinear(const ImagePlane& plane, const Eigen::Vector2d& pixel) {
  if (!pixel.allFinite() || plane.rows() < 2 || plane.cols() < 2 || !Holds(plane, pixel, 0))
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::Index u = std::min(static_cast<Eigen::Index>(pixel.x()), plane.cols() - 2);
  const Eigen::Index v = std::min(static_cast<Eigen::Index>(pixel.y()), plane.rows() - 2);
  const double fu = pixel.x() - static_cast<double>(u), fv = pixel.y() - static_cast<double>(v);
  const auto at = [&](Eigen::Index row, Eigen::Index column) {
    return static_cast<double>(plane(row, column));
  };
  return (1 - fv) * ((1 - fu) * at(v, u) + fu * at(v, u + 1)) +
         fv * ((1 - fu) * at(v + 1, u) + fu * at(v + 1, u + 1));
}

}  // namespace luxfit
