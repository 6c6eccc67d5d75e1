#include "forward/light/internal/adaptive_patches.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/internal/expect_luminaire.h"

namespace luxfit {
namespace {

// Holds the light that is known before the patches are cut.
struct KnownLight {
  Scene scene;
  RayScene rays;
  Patches patches;
  Eigen::VectorXf indirect_lx;
  std::vector<Luminaire> luminaires;

  double IlluminanceLx(int facet, const Element& element) const {
    return DirectLx(element) + IndirectLx(facet, element);
  }

 private:
  double DirectLx(const Element& element) const {
    double sum = 0;
    for (const Luminaire& luminaire : luminaires) {
      const double lx =
          luminaire.flux_lm * DirectIlluminancePerLumen(luminaire, element.center, element.normal).lx_per_lm;
      if (lx > 0 && !rays.Occluded(LiftedOff(element.center, element.normal), luminaire.position)) sum += lx;
    }
    return sum;
  }
  double IndirectLx(int facet, const Element& element) const {
    const Eigen::Vector2d at = scene.facets[static_cast<size_t>(facet)].CoordinatesOf(element.center);
    const int coarse = patches.ElementAt(facet, at[0], at[1]);
    return coarse < 0 ? 0 : static_cast<double>(indirect_lx[coarse]);
  }
};

}  // namespace

PatchesOptions AdaptivePatches(const Room& coarse, Eigen::VectorXf indirect_lx,
                               std::vector<Luminaire> luminaires, double error_percent,
                               const PatchesOptions& sizes) {
  if (!(error_percent > 0)) throw std::invalid_argument("AdaptivePatches: expected error_percent > 0");
  if (indirect_lx.size() != static_cast<Eigen::Index>(coarse.patches.elements.size()))
    throw std::invalid_argument("AdaptivePatches: expected one illuminance an element");
  ExpectValid(luminaires);
  double area_m2 = 0, flux_lm = 0;
  for (const Facet& facet : coarse.scene.facets) area_m2 += facet.AreaM2();
  for (const Luminaire& luminaire : luminaires) flux_lm += luminaire.flux_lm;
  const double bound_lx = error_percent / 100 * flux_lm / area_m2;
  const auto known = std::make_shared<const KnownLight>(KnownLight{
      coarse.scene, RayScene(coarse.scene), coarse.patches, std::move(indirect_lx), std::move(luminaires)});
  PatchesOptions options = sizes;
  options.must_split = [known, area_m2, bound_lx](int facet, const std::vector<Element>& elements) {
    double area = 0, sum = 0, squares = 0;
    for (const Element& element : elements) {
      const double lx = known->IlluminanceLx(facet, element);
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
