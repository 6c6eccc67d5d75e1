#include "forward/room/internal/expect_valid.h"

#include <stdexcept>

namespace luxfit {

void ExpectThat(bool holds, const std::string& of, const char* what) {
  if (!holds) throw std::invalid_argument(of + ": expected " + what);
}

void ExpectValid(const Scene& scene) {
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const Facet& facet = scene.facets[f];
    const std::string name = "facet " + std::to_string(f);
    ExpectThat(facet.origin.allFinite() && facet.edge_u.allFinite() && facet.edge_v.allFinite(), name,
               "finite corners");
    ExpectThat(facet.AreaM2() > 0, name, "an area above 0 (leave out facets that have none)");
    ExpectThat(facet.material >= 0 && static_cast<size_t>(facet.material) < scene.materials.size(), name,
               "the index of one of the scene's materials");
  }
}

}  // namespace luxfit
