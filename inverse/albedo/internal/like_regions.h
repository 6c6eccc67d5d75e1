// Grows regions of like value over a graph of neighbours.
//
//   z^2 = (x_a - x_b)^2 / (v_a + v_b + 2 f^2)
//
// x: weighted mean of a region's nodes, v: its variance, f: the error that all nodes of a region share. The pair of least
// z^2 is merged first, until neighbours differ by most_sigmas and more (Wald's test of "both have one value", which is
// nested in "each has its own"). Regions smaller than least_m2 then join the neighbour that is most like them. Their nodes
// have no say in its value: they are a border or a stain.
//
// Deterministic. Throws std::invalid_argument for an edge that names no node, and variances that are not positive.
// Sources: Beaulieu and Goldberg (1989), "Hierarchy in picture segmentation" (stepwise merging); Wald (1943).
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_LIKE_REGIONS_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_LIKE_REGIONS_H_

#include <limits>
#include <utility>
#include <vector>

namespace luxfit {

struct RegionNode {
  double value = 0, variance = 1;
  double area_m2 = 0;
};

struct LikeRegionsOptions {
  double shared_sigma = 0;  // f
  double most_sigmas =
      3;  // hundreds of pairs are compared: fewer sigmas would tell some of them apart by chance
  double least_m2 = 0.3;  // as planes that get a material of their own (forward/mesh/planes.h)
};

struct LikeRegions {
  int count = 0;
  std::vector<int> of_node;                                  // from 0, in the order of their first nodes
  std::vector<bool> has_say;                                 // by node; false: taken in by a larger region
  double least_z = std::numeric_limits<double>::infinity();  // of neighbours that stayed apart
};

LikeRegions GrowLikeRegions(const std::vector<RegionNode>& nodes,
                            const std::vector<std::pair<int, int>>& edges,
                            const LikeRegionsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_LIKE_REGIONS_H_
