// Returns the points of a luminous surface that a lobe is summed over.
//
// Their number along each side grows with that side and with the lobe's sharpness, and falls with the distance; it is
// at most 24. A long, narrow rectangle thus has many points along, few across.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

// Returns a rule that is made once: rules depend on nothing but shape and orders. Orders above the largest, 24, count
// as 24. Of a disc, which has one order, the first counts.
const std::vector<SurfaceSample>& SurfaceRule(LuminaireShape shape, int along, int across);

// Returns the rule for a receiver; empty where all of the surface lies behind the receiver's plane.
const std::vector<SurfaceSample>& SurfaceRuleFor(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                                 const Eigen::Vector3d& normal);

// Returns the rule that stands for the closed form of a diffuse rectangle, 2 to 4 points a side by its distance: to 3e-5 of
// the illuminance of a receiver that faces it, in less than half of the time. nullptr where the rectangle is too near, or
// cut by the receiver's plane, and for discs: their closed form is as fast.
const std::vector<SurfaceSample>* FarRuleFor(const LuminousSurface& surface, const Eigen::Vector3d& p,
                                             const Eigen::Vector3d& normal);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_SURFACE_RULE_H_
