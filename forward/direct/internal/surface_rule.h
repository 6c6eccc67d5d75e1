// Points of a luminous surface that a lobe is summed over, as many as its sharpness and the distance ask for.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Made once: rules depend on nothing but shape and order. Orders above the largest, 24, count as that.
const std::vector<SurfaceSample>& SurfaceRule(LuminaireShape shape, int order);

// Empty where all of the surface lies behind the receiver's plane.
const std::vector<SurfaceSample>& SurfaceRuleFor(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                                 const Eigen::Vector3d& normal);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_
