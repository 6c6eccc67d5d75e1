// Moves whole planes of a mesh, such as a wall, along their normals.
//
//   d = argmin |d|  with  n . d = by_m  and  m . d = 0 for the planes m of the other facets that have a corner there
//
// A corner on the plane moves by d: along the facets that adjoin, which stretch, so that the room stays closed. Facets that
// are no parallelograms afterwards become triangles. Pieces up to kFlatPieceM deep that touch the plane (a door, a board)
// go along as they are.
//
// Metres, world frame. Corners within 1 mm of a plane are on it, whatever they belong to.
// Assumes a scene without `surface` (a mesh that is not laid on planes); throws std::invalid_argument for others.
// Source: own.
#ifndef LUXFIT_FORWARD_CHANGES_PLANE_MOVES_H_
#define LUXFIT_FORWARD_CHANGES_PLANE_MOVES_H_

#include <Eigen/Core>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

constexpr double kOnPlaneM = 1e-3;
constexpr double kFlatPieceM = 0.1;

struct PlaneMove {
  Eigen::Vector3d normal;  // unit, the way its facets face
  double offset_m = 0;     // of the plane in the mesh: normal . p
  double by_m = 0;         // along the normal; positive: into the room
};

// Moves one plane after the other.
Scene WithPlanesMoved(Scene scene, const std::vector<PlaneMove>& moves);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_CHANGES_PLANE_MOVES_H_
