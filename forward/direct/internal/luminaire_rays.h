// Returns rays that follow a luminaire's distribution, and the share of its flux that each patch gets first.
//
//   F_j = (1 / Phi) int_{d meets j first} I(d) dOmega
//
// Directions are a weighted isocell: cells of equal area of the unit disc, their radius mapped through the
// cumulative distribution of the intensity over gamma. Every ray of a rotationally symmetric luminaire thus
// carries the same flux. Where the intensity depends on C too, a ray carries I(d) over the mean of I at its
// gamma. Rays start at points spread over the luminous surface.
//
// The results are shares; they add up to 1 in a closed room. A ray that meets the back of a facet, or leaves
// the scene, brings nothing. Throws std::invalid_argument if ray_count < 1. Source: Masset, Bruls, Kerschen
// (2011), "Partition of the circle in cells of equal area and shape", weighted form.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_RAYS_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_RAYS_H_

#include <Eigen/Core>

#include "forward/luminaire/luminaire.h"
#include "forward/room/patches.h"
#include "forward/room/visibility.h"

namespace luxfit {

// Holds about `ray_count` unit directions and the part of the flux that each carries.
struct LuminaireRays {
  Eigen::Matrix3Xd directions;
  Eigen::VectorXd share;
};
LuminaireRays SampleDistribution(const Luminaire& luminaire, int ray_count);

// Returns the share of each patch.
Eigen::VectorXf LuminaireFormFactors(const RayScene& rays, const Patches& patches, const Luminaire& luminaire,
                                     int ray_count = 16384);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_RAYS_H_
