// Gathers the elements of even patches, from which regions grow (like_regions.h).
//
//   mean (x - mean x)^2 <= (s^2 + f^2) (1 + 3 sqrt(2 / n))      chi squared of n elements at 3 sigmas: the patch is even
//
// Single elements that scatter far (a carpet's) would join by chance those that are off the same way. An even patch is one
// node, so that this is averaged out before regions grow. The elements of other patches, through which a border runs, are
// nodes of their own.
//
// Source: Haralick and Shapiro (1985), "Image segmentation techniques" (growing from regions that are uniform).
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_EVEN_PATCHES_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_EVEN_PATCHES_H_

#include <utility>
#include <vector>

#include "inverse/albedo/internal/like_regions.h"

namespace luxfit {

struct ValueInPatch {
  double value = 0, area_m2 = 0;
  int patch = 0;
};

struct RegionGraph {
  std::vector<RegionNode> nodes;
  std::vector<std::pair<int, int>> edges;
  std::vector<int> of_value;  // nodes
};

// `pairs`: values that adjoin. `sigma`: s, of one value; `shared_sigma`: f.
RegionGraph GraphOfEvenPatches(const std::vector<ValueInPatch>& values,
                               const std::vector<std::pair<int, int>>& pairs, double sigma,
                               double shared_sigma);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_EVEN_PATCHES_H_
