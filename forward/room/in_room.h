// Tells whether a point stands in the open of a room: not in a solid, beyond a wall, or outside; and brings points there.
//
// In a room, rays in all directions meet the fronts of facets (and, through openings, nothing). From outside the
// room, or from beyond the plane of a ceiling, every ray meets a back or leaves. From inside a solid that was
// modelled without its bottom, at least the upper half meets backs; so it does just below a table top that is a
// single sheet. So a point stands outside where no ray meets a front, or more than 40 % meet a back.
//
// Source: ray parity as in O'Rourke (1998), "Computational Geometry in C", sec. 7.3, by facing instead of count.
#ifndef LUXFIT_FORWARD_ROOM_IN_ROOM_H_
#define LUXFIT_FORWARD_ROOM_IN_ROOM_H_

#include <Eigen/Core>

#include "forward/room/visibility.h"

namespace luxfit {

// `p`: in world, m. False in an empty scene. Traces 128 rays.
bool IsInRoom(const RayScene& rays, const Eigen::Vector3d& p);

// Returns the place moved along the normal of the facet that a ray of `scene` has hit, until it is `in_front_m` before the facet's plane, on the
// side from which the ray came. World frame, m.
Eigen::Vector3d InFrontOf(const Scene& scene, const RayHit& hit, const Eigen::Vector3d& place,
                          double in_front_m);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_IN_ROOM_H_
