// Tells whether a point of a surface lies inside a solid that stands on it.
//
// From inside a solid every direction meets the back of a facet. Beside a single sheet (a partition, a shelf,
// a table top drawn without thickness) only the directions that it covers do. So a point counts as inside
// where less than a quarter of its hemisphere's directions, equal in solid angle, lead into the open. A
// direction leads into the open if its ray meets nothing, or a front that does not itself face a back. Fronts
// that face a back are a skirting within a cabinet, or the wall that a solid stands flush with. At such a
// wall a ray meets the wall's front and the solid's back in one place.
//
// Backs that leave less than a quarter open are mistaken for a solid. Examples are a shelf at a distance of a
// fifth of its width, or a picture that hangs some mm off its wall.
//
// Source: ray parity as in O'Rourke (1998), "Computational Geometry in C", sec. 7.3, by facing instead of
// count.
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_INSIDE_SOLID_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_INSIDE_SOLID_H_

#include <Eigen/Core>

#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

// Tests `p` on a surface with unit normal `normal`; `rays` are those of the scene. It costs one ray where the
// ray along the normal meets no back.
bool IsInsideSolid(const Scene& scene, const RayScene& rays, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& normal);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_INSIDE_SOLID_H_
