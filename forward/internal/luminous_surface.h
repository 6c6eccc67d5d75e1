// Points of a luminaire's luminous surface for random or low-discrepancy sampling.
#ifndef LUXFIT_FORWARD_INTERNAL_LUMINOUS_SURFACE_H_
#define LUXFIT_FORWARD_INTERNAL_LUMINOUS_SURFACE_H_

#include <Eigen/Core>

#include "forward/luminaire.h"

namespace luxfit {

// The unit square mapped onto the surface with even density, in world; points and spheres are their centre.
Eigen::Vector3d SurfacePointAt(const Luminaire& luminaire, const LuminaireAxes& axes,
                               const Eigen::Vector2d& unit);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_INTERNAL_LUMINOUS_SURFACE_H_
