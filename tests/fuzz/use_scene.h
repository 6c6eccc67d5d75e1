// What every scene that a mesh reader returns must survive: the mesh check and, where small, the subdivision.
#ifndef LUXFIT_TESTS_FUZZ_USE_SCENE_H_
#define LUXFIT_TESTS_FUZZ_USE_SCENE_H_

#include <cstddef>
#include <cstdlib>

#include "forward/mesh/mesh_check.h"
#include "forward/room/patches.h"
#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

inline void Require(bool holds) {
  if (!holds) std::abort();
}

inline void UseScene(const Scene& scene) {
  constexpr size_t kMaxFacets = 64;
  constexpr double kMaxAreaM2 = 100, kMaxLengthM = 100;
  double area_m2 = 0;
  for (const Facet& facet : scene.facets) {
    Require(facet.Normal().allFinite() && facet.AreaM2() > 0);
    Require(facet.material >= 0 && static_cast<size_t>(facet.material) < scene.materials.size());
    area_m2 += facet.AreaM2();
  }
  if (scene.facets.size() > kMaxFacets) return;
  CheckMesh(scene);
  if (area_m2 > kMaxAreaM2 || scene.Bounds().sizes().maxCoeff() > kMaxLengthM) return;
  const Scene clean = WithoutOverlaps(scene);
  if (clean.facets.size() > 4 * kMaxFacets) return;
  for (const Element& element : Subdivide(clean, RayScene(clean), {4, 2}).elements)
    Require(element.center.allFinite() && element.area_m2 >= 0);
}

}  // namespace luxfit

#endif  // LUXFIT_TESTS_FUZZ_USE_SCENE_H_
