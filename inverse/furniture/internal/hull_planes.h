// Finds the planes of a room's hull, such as walls, floor and ceiling.
//
//   plane of the hull = facets that lie in one plane and face one way, kLeastPlaneM2 together, behind which no front of the
//                       mesh is met: furniture has the room's surfaces behind it
//
// A facet counts from 0.1 m2 on: scans, whose triangles are smaller, have no such planes. Metres, world frame. Source: own.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_HULL_PLANES_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_HULL_PLANES_H_

#include <Eigen/Core>
#include <vector>

#include "forward/room/scene.h"
#include "forward/room/visibility.h"
#include "inverse/furniture/internal/piece_cells.h"

namespace luxfit {

constexpr double kLeastPlaneM2 = 1;

struct HullPlane {
  Eigen::Vector3d normal;   // unit, into the room
  double offset_m = 0;      // normal . p of its points
  std::vector<int> facets;  // into scene.facets, the largest first
  double area_m2 = 0;
  std::vector<PieceCell> cells;  // about 700 of them, 0.1 m wide or more
};

// Returns them in the order of their largest facets. `rays`: of the same scene.
std::vector<HullPlane> FindHullPlanes(const Scene& scene, const RayScene& rays);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_HULL_PLANES_H_
