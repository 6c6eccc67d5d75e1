#include "forward/views/illuminance_plane.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

double SpacingOfEn12464(double length_u, double length_v) {
  const double longer = std::max(length_u, length_v), shorter = std::min(length_u, length_v);
  return std::min(10.0, 0.2 * std::pow(5, std::log10(longer >= 2 * shorter ? shorter : longer)));
}

}  // namespace

PlaneGrid GridOf(const IlluminancePlane& plane) {
  const double length_u = plane.edge_u.norm(), length_v = plane.edge_v.norm();
  if (!(plane.edge_u.cross(plane.edge_v).norm() > 0) || !(plane.spacing_m >= 0))
    throw std::invalid_argument("GridOf: expected a plane with an area and a spacing >= 0");
  const double spacing = plane.spacing_m > 0 ? plane.spacing_m : SpacingOfEn12464(length_u, length_v);
  return GridOf(plane, std::max(1, static_cast<int>(std::lround(length_u / spacing))),
                std::max(1, static_cast<int>(std::lround(length_v / spacing))));
}

PlaneGrid GridOf(const IlluminancePlane& plane, int count_u, int count_v) {
  const Eigen::Vector3d cross = plane.edge_u.cross(plane.edge_v);
  if (!(cross.norm() > 0) || count_u < 1 || count_v < 1)
    throw std::invalid_argument("GridOf: expected a plane with an area and counts >= 1");
  PlaneGrid grid;
  grid.count_u = count_u;
  grid.count_v = count_v;
  grid.normal = cross.normalized();
  grid.points.resize(3, static_cast<Eigen::Index>(grid.count_u) * grid.count_v);
  for (Eigen::Index k = 0; k < grid.points.cols(); ++k) {
    const Eigen::Index row = k / grid.count_u, column = k - row * grid.count_u;
    const double u = (static_cast<double>(column) + 0.5) / grid.count_u;
    const double v = (static_cast<double>(row) + 0.5) / grid.count_v;
    grid.points.col(k) = plane.origin + u * plane.edge_u + v * plane.edge_v;
  }
  return grid;
}

}  // namespace luxfit
