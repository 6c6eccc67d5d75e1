#include "forward/mesh/named_planes.h"

#include <algorithm>
#include <map>
#include <vector>

#include "forward/mesh/internal/grow_planes.h"
#include "forward/mesh/internal/plane_names.h"
#include "forward/mesh/internal/scan_mesh.h"
#include "forward/mesh/planes.h"

namespace luxfit {
namespace {

// Tells whether photos showed what has this material.
bool IsFound(const std::string& material) { return material.rfind("found ", 0) == 0; }

}  // namespace

std::string SoleMaterialOf(const Scene& scene) {
  std::string sole;
  for (const std::string& name : scene.materials) {
    if (IsFound(name)) continue;
    if (!sole.empty()) return "";
    sole = name;
  }
  return sole;
}

Scene WithPlanesNamed(Scene mesh, const std::string& material) {
  if (std::count(mesh.materials.begin(), mesh.materials.end(), material) == 0) return mesh;
  const ScanMesh triangles = MakeScanMesh(mesh);
  const PlanarRegions regions = GrowPlanes(triangles, PlanesOptions{}.off_plane_m);
  const std::vector<int> of_region = NamePlanes(triangles, regions, material, mesh.materials);
  for (Facet& facet : mesh.facets) facet.material = 0;  // of one without area, which is no triangle
  for (size_t t = 0; t < triangles.triangles.size(); ++t)
    mesh.facets[static_cast<size_t>(triangles.facet[t])].material =
        of_region[static_cast<size_t>(regions.of_triangle[t])];
  return mesh;
}

bool AreNamedPlanes(const Scene& scene) {
  std::map<std::string, int> count = {
      {"floor", 0}, {"ceiling", 0}, {"wall", 0}, {"surface", 0}, {"details", 0}};
  return std::all_of(scene.materials.begin(), scene.materials.end(), [&count](const std::string& name) {
    if (IsFound(name)) return true;
    const std::string kind = name.substr(0, name.find(' '));
    const auto at = count.find(kind);
    if (at == count.end()) return false;
    const int number = ++at->second;
    const bool is_single = number == 1 && (kind == "floor" || kind == "ceiling");
    return name == (is_single ? kind : kind + " " + std::to_string(number));
  });
}

}  // namespace luxfit
