// Form factors from elements to patches as if nothing stood between, each by the cheapest rule that is exact
// enough.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_UNOCCLUDED_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_UNOCCLUDED_H_

#include <vector>

#include "forward/room/patches.h"

namespace luxfit {

class UnoccludedFactors {
 public:
  // `contour_always`: every pair by double contour integration.
  UnoccludedFactors(const Patches& patches, bool contour_always);

  // Patches that some element of patch p may see from near, so that Far does not hold for them.
  std::vector<int> NearOf(int p) const;
  // Factors to all patches by the rule for distant ones; `row` has `patches` entries.
  void Far(const Element& element, float* row) const;
  // By the rule that the distance asks for.
  double Near(const Element& element, int j) const;

 private:
  double Quadrature(const Element& element, int j, int element_order, int patch_order) const;

  const Patches& patches_;
  bool contour_always_;
  std::vector<double> radius_;          // of patches, m
  std::vector<double> element_radius_;  // largest of each patch, m
  std::vector<float> points_;   // four Gauss points of every patch: x, y, z, area share, each `count_` long
  std::vector<float> normals_;  // x, y, z, each `count_` long
  size_t count_;
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_UNOCCLUDED_H_
