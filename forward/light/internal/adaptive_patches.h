// Chooses patches that are small where illuminance varies and large elsewhere.
//
//   split while  sqrt(A_patch / A) std(E over the patch) > error * Phi / A
//
// Illuminance varies near luminaires, at the edges of shadows and in corners. E is the illuminance at the
// elements' centres: direct from the luminaires, and reflected as a coarser solution has it. Shadows take one
// ray to the luminaire's centre, so their edges are found to within an element. A is the area of all facets;
// Phi / A is the mean direct illuminance of a closed room. The left side is the patch's part of the root mean
// square by which constant patches miss the light that they send. Patches that meet the bound add up to a few
// times it at most.
//
// Units are lx and m, world frame. Throws std::invalid_argument unless error_percent > 0 and there is one
// illuminance per element of the coarser room.
// Source: Cohen, Greenberg, Immel, Brock (1986), "An efficient radiosity approach for realistic image
// synthesis" (adaptive subdivision from a first solution); Lischinski, Tampieri, Greenberg (1992),
// "Discontinuity meshing for accurate radiosity" (why edges matter).
#ifndef LUXFIT_FORWARD_LIGHT_INTERNAL_ADAPTIVE_PATCHES_H_
#define LUXFIT_FORWARD_LIGHT_INTERNAL_ADAPTIVE_PATCHES_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/patches.h"

namespace luxfit {

// Returns `sizes` with the criterion added: patch_size_m is the largest patch, element_size_m the smallest.
// They serve rooms made of the same scene as `coarse`, whose patches the options copy. `indirect_lx` is by
// element of `coarse`, all luminaires on.
PatchesOptions AdaptivePatches(const Room& coarse, Eigen::VectorXf indirect_lx,
                               std::vector<Luminaire> luminaires, double error_percent,
                               const PatchesOptions& sizes = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_INTERNAL_ADAPTIVE_PATCHES_H_
