// Finds the main directions of a room, and its bounds along them.
//
//   theta = arg(sum_f A_f e^(4 i phi_f)) / 4          phi: heading of the normal of an upright facet of area A
//
// Walls at right angles add up whatever corner they form. Source: own.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_ROOM_AXES_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_ROOM_AXES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <vector>

#include "forward/mesh/outline.h"
#include "forward/room/scene.h"

namespace luxfit {

struct RoomAxes {
  double turn_rad = 0;  // of the first axis against the world's x, within 45 degrees
  Eigen::Matrix3d world_from_axes = Eigen::Matrix3d::Identity();
  Eigen::AlignedBox3d bounds;  // along the axes, m
};

inline RoomAxes AxesOf(const Scene& scene) {
  std::complex<double> sum = 0;
  for (const Facet& facet : scene.facets) {
    const Eigen::Vector3d n = facet.Normal();
    if (std::abs(n.z()) < 0.1) sum += facet.AreaM2() * std::polar(1.0, 4 * std::atan2(n.y(), n.x()));
  }
  RoomAxes axes;
  axes.turn_rad = sum == 0.0 ? 0 : std::arg(sum) / 4;
  axes.world_from_axes = Eigen::AngleAxisd(axes.turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (const Facet& facet : scene.facets) {
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0})
        axes.bounds.extend(axes.world_from_axes.transpose() * facet.PointAt(u, v));
  }
  return axes;
}

// Return places, the bounds of facets, and those of a box that stands along the axes, all along the room's axes.
inline std::vector<Eigen::Vector3d> AlongAxes(std::vector<Eigen::Vector3d> places, const RoomAxes& axes) {
  for (Eigen::Vector3d& p : places) p = axes.world_from_axes.transpose() * p;
  return places;
}
inline Eigen::AlignedBox3d AlongAxes(const Scene& scene, const std::vector<int>& facets,
                                     const RoomAxes& axes) {
  Eigen::AlignedBox3d bounds;
  for (const int f : facets) {
    const Facet& facet = scene.facets[static_cast<size_t>(f)];
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0})
        if (facet.kind == FacetKind::kParallelogram || u + v < 2)
          bounds.extend(axes.world_from_axes.transpose() * facet.PointAt(u, v));
  }
  return bounds;
}
inline Eigen::AlignedBox3d AlongAxes(const RoomBox& box, const RoomAxes& axes) {
  const Eigen::Vector3d center = axes.world_from_axes.transpose() * (0.5 * (box.min_m + box.max_m)),
                        half = 0.5 * (box.max_m - box.min_m);
  return {center - half, center + half};
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_ROOM_AXES_H_
