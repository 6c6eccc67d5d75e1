// Patches that are small where direct light varies, near luminaires and at the edges of shadows, and large
// elsewhere.
//
//   split while  sqrt(A_patch / A) std(D over the patch) > error * Phi / A
//
// D: direct illuminance at the elements' centres; A: area of all facets; Phi / A: mean direct illuminance of
// a closed room. The left side is the patch's part of the root mean square by which constant patches miss the
// light that they send; patches that meet the bound add up to some times it at most. Shadows are looked for
// by one ray to the luminaire's centre: their edges are found to an element.
//
// Throws std::invalid_argument unless error_percent > 0.
// Source: Cohen, Greenberg, Immel, Brock (1986), "An efficient radiosity approach for realistic image
// synthesis" (adaptive subdivision); Lischinski, Tampieri, Greenberg (1992), "Discontinuity meshing for
// accurate radiosity" (why edges matter).
#ifndef LUXFIT_FORWARD_ADAPTIVE_PATCHES_H_
#define LUXFIT_FORWARD_ADAPTIVE_PATCHES_H_

#include <vector>

#include "forward/luminaire.h"
#include "forward/patches.h"
#include "forward/scene.h"
#include "forward/visibility.h"

namespace luxfit {

// `sizes` with the criterion added: patch_size_m is the largest patch, element_size_m the smallest. Refers to
// scene and rays, which must outlive the Subdivide call.
PatchesOptions AdaptivePatches(const Scene& scene, const RayScene& rays,
                               const std::vector<Luminaire>& luminaires, double error_percent,
                               const PatchesOptions& sizes = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ADAPTIVE_PATCHES_H_
