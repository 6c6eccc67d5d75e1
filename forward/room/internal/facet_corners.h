// Returns the corners of a facet, counter-clockwise seen from its front, and the box round them (m).
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_FACET_CORNERS_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_FACET_CORNERS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "forward/room/scene.h"

namespace luxfit {

struct FacetCorners {
  std::array<Eigen::Vector3d, 4> points;
  size_t count = 4;
  const Eigen::Vector3d* begin() const { return points.data(); }
  const Eigen::Vector3d* end() const { return points.data() + count; }
};

inline FacetCorners CornersOf(const Facet& facet) {
  if (facet.kind == FacetKind::kTriangle)
    return {{facet.origin, facet.PointAt(1, 0), facet.PointAt(0, 1), Eigen::Vector3d::Zero()}, 3};
  return {{facet.origin, facet.PointAt(1, 0), facet.PointAt(1, 1), facet.PointAt(0, 1)}, 4};
}

inline Eigen::AlignedBox3d BoxOf(const Facet& facet, double margin_m) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : CornersOf(facet)) box.extend(p);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(margin_m);
  return {box.min() - margin, box.max() + margin};
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_FACET_CORNERS_H_
