// Returns the points of a luminous surface that a lobe is summed over.
//
// Their number grows with the lobe's sharpness and falls with the distance; at most 24 a side.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Returns a rule that is made once: rules depend on nothing but shape and order. Orders above the largest,
// 24, count as 24.
const std::vector<SurfaceSample>& SurfaceRule(LuminaireShape shape, int order);

// Returns the rule for a receiver; empty where all of the surface lies behind the receiver's plane.
const std::vector<SurfaceSample>& SurfaceRuleFor(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                                 const Eigen::Vector3d& normal);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_
