// Any bytes as an OBJ or PLY file: the reader must answer with a scene or a std::runtime_error, and what it
// reads must survive the mesh check and, where small, the subdivision.
//
// The first byte chooses the format. Run by .ci/fuzz.sh. Source: LLVM, "libFuzzer".
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "forward/mesh_check.h"
#include "forward/mesh_file.h"
#include "forward/overlaps.h"
#include "forward/patches.h"
#include "forward/visibility.h"

namespace luxfit {
namespace {

constexpr size_t kMaxFacets = 64;
constexpr double kMaxAreaM2 = 100, kMaxLengthM = 100;

void Require(bool holds) {
  if (!holds) std::abort();
}

void UseScene(const Scene& scene) {
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

}  // namespace
}  // namespace luxfit

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    luxfit::UseScene(luxfit::ParseScene(
        bytes, data[0] % 2 == 0 ? luxfit::MeshFormat::kObj : luxfit::MeshFormat::kPly, "fuzz"));
  } catch (const std::runtime_error&) {
    return 0;
  }
  return 0;
}
