// Patches that are small where illuminance varies, near luminaires, at the edges of shadows, in corners, and
// large elsewhere.
//
//   split while  sqrt(A_patch / A) std(E over the patch) > error * Phi / A
//
// E: illuminance at the elements' centres, direct from the luminaires (shadows by one ray to the luminaire's
// centre: their edges are found to an element) and reflected as a coarser solution has it. A: area of all
// facets; Phi / A: mean direct illuminance of a closed room. The left side is the patch's part of the root
// mean square by which constant patches miss the light that they send; patches that meet the bound add up to
// some times it at most.
//
// lx, m, world frame. Throws std::invalid_argument unless error_percent > 0 and there is one illuminance an
// element of the coarser room.
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

// `sizes` with the criterion added: patch_size_m is the largest patch, element_size_m the smallest. For rooms
// made of the same scene as `coarse`, of whose patches the options keep a copy; `indirect_lx` by element of
// it, all luminaires on.
PatchesOptions AdaptivePatches(const Room& coarse, Eigen::VectorXf indirect_lx,
                               std::vector<Luminaire> luminaires, double error_percent,
                               const PatchesOptions& sizes = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_INTERNAL_ADAPTIVE_PATCHES_H_
