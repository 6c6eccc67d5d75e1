// Whether a point of a surface lies inside a solid that stands on it.
//
// From inside a solid every direction meets the back of a facet; beside a single sheet (a partition, a shelf,
// a table top drawn without thickness) only those that it covers. So a point counts as inside where less than
// a quarter of the directions of its hemisphere, equal in solid angle, lead into the open: to nothing, or to
// a front that does not itself face a back. The latter is what a skirting within a cabinet does, or the wall
// that a solid stands flush with, whose front and the solid's back a ray meets in one place.
//
// What this takes for a solid and is none: backs that leave less than a quarter open, as of a shelf at a
// distance of a fifth of its width, or of a picture that hangs some mm off its wall.
// Source: ray parity as in O'Rourke (1998), "Computational Geometry in C", sec. 7.3, by facing instead of
// count.
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_INSIDE_SOLID_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_INSIDE_SOLID_H_

#include <Eigen/Core>

#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

// `p` on a surface with unit normal `normal`; `rays` are of the scene. Costs one ray where that along the
// normal meets no back.
bool IsInsideSolid(const Scene& scene, const RayScene& rays, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& normal);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_INSIDE_SOLID_H_
