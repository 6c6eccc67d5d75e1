#include "forward/adaptive_patches.h"

#include <cmath>
#include <stdexcept>

#include "forward/direct_light.h"
#include "forward/internal/expect_valid.h"

namespace luxfit {
namespace {

double DirectLx(const RayScene& rays, const std::vector<Luminaire>& luminaires, const Element& element) {
  double sum = 0;
  for (const Luminaire& luminaire : luminaires) {
    const double lx =
        luminaire.flux_lm * DirectIlluminancePerLumen(luminaire, element.center, element.normal).lx_per_lm;
    if (lx > 0 && !rays.Occluded(LiftedOff(element.center, element.normal), luminaire.position)) sum += lx;
  }
  return sum;
}

}  // namespace

PatchesOptions AdaptivePatches(const Scene& scene, const RayScene& rays,
                               const std::vector<Luminaire>& luminaires, double error_percent,
                               const PatchesOptions& sizes) {
  if (!(error_percent > 0)) throw std::invalid_argument("AdaptivePatches: expected error_percent > 0");
  ExpectValid(luminaires);
  double area_m2 = 0, flux_lm = 0;
  for (const Facet& facet : scene.facets) area_m2 += facet.AreaM2();
  for (const Luminaire& luminaire : luminaires) flux_lm += luminaire.flux_lm;
  const double bound_lx = error_percent / 100 * flux_lm / area_m2;
  PatchesOptions options = sizes;
  options.must_split = [&rays, luminaires, area_m2, bound_lx](const std::vector<Element>& elements) {
    double area = 0, sum = 0, squares = 0;
    for (const Element& element : elements) {
      const double lx = DirectLx(rays, luminaires, element);
      area += element.area_m2;
      sum += element.area_m2 * lx;
      squares += element.area_m2 * lx * lx;
    }
    const double variance = std::max(0.0, squares / area - sum / area * (sum / area));
    return std::sqrt(area / area_m2 * variance) > bound_lx;
  };
  return options;
}

}  // namespace luxfit
