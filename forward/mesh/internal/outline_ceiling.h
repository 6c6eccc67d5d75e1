// Cuts the floor or the ceiling of an outline into plane pieces.
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_OUTLINE_CEILING_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_OUTLINE_CEILING_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "forward/mesh/outline.h"

namespace luxfit {

// Returns plane polygons that together have the given border, all counter-clockwise seen from above as it is.
// Where the corners lie in one plane and have right angles seen from above, the pieces are parallelograms.
std::vector<std::vector<Eigen::Vector3d>> PlanePieces(const std::vector<Eigen::Vector3d>& border);

// Returns the corners of a box seen from above, counter-clockwise, turned as it is.
std::array<Eigen::Vector2d, 4> PlanOf(const RoomBox& box);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_OUTLINE_CEILING_H_
