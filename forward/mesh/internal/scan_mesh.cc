#include "forward/mesh/internal/scan_mesh.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "forward/room/internal/mesh_topology.h"

namespace luxfit {
namespace {

std::vector<Side> SidesOf(const ScanMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k)
      sides.push_back(
          {mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3], static_cast<int>(t), static_cast<int>(k)});
  }
  // Sides of one edge stand together, whichever way they run.
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::make_tuple(std::min(x.from, x.to), std::max(x.from, x.to), x.triangle) <
           std::make_tuple(std::min(y.from, y.to), std::max(y.from, y.to), y.triangle);
  });
  return sides;
}

template <typename Use>
void ForEachEdge(const std::vector<Side>& sides, const Use& use) {
  const auto same = [](const Side& x, const Side& y) {
    return std::minmax(x.from, x.to) == std::minmax(y.from, y.to);
  };
  for (size_t first = 0, last; first < sides.size(); first = last) {
    for (last = first + 1; last < sides.size() && same(sides[first], sides[last]);) ++last;
    use(first, last);
  }
}

}  // namespace

bool AddTriangle(int a, int b, int c, int material, ScanMesh& mesh) {
  constexpr double kLeastM2 = 1e-10;
  const auto at = [&](int v) -> const Eigen::Vector3d& { return mesh.vertices[static_cast<size_t>(v)]; };
  if ((at(b) - at(a)).cross(at(c) - at(a)).norm() < 2 * kLeastM2) return false;
  mesh.triangles.push_back({a, b, c});
  mesh.material.push_back(material);
  return true;
}

std::vector<std::vector<Side>> RimsOf(const ScanMesh& mesh) {
  const std::vector<Side> sides = SidesOf(mesh);
  std::multimap<int, Side> open;
  ForEachEdge(sides, [&](size_t first, size_t last) {
    if (last - first == 1) open.emplace(sides[first].from, sides[first]);
  });
  std::vector<std::vector<Side>> rims;
  while (!open.empty()) {
    std::vector<Side> path;
    for (auto at = open.begin(); at != open.end();) {
      path.push_back(at->second);
      const int next = at->second.to;
      open.erase(at);
      const auto loop =
          std::find_if(path.begin(), path.end(), [&](const Side& side) { return side.from == next; });
      if (loop != path.end()) {
        rims.emplace_back(loop, path.end());
        path.erase(loop, path.end());
      }
      at = path.empty() ? open.end() : open.find(next);
    }
  }
  return rims;
}

void FindNeighbours(ScanMesh& mesh) {
  mesh.across.assign(mesh.triangles.size(), {-1, -1, -1});
  const std::vector<Side> sides = SidesOf(mesh);
  ForEachEdge(sides, [&](size_t first, size_t last) {
    if (last - first != 2 || sides[first].from != sides[first + 1].to) return;
    const Side &a = sides[first], &b = sides[first + 1];
    mesh.across[static_cast<size_t>(a.triangle)][static_cast<size_t>(a.k)] = b.triangle;
    mesh.across[static_cast<size_t>(b.triangle)][static_cast<size_t>(b.k)] = a.triangle;
  });
}

ScanMesh MakeScanMesh(const Scene& scene) {
  MeshTopology topology = MakeTopology(scene);
  ScanMesh mesh;
  mesh.vertices = std::move(topology.vertices);
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const std::array<int, 4>& c = topology.corners[f];
    const int material = scene.facets[f].material;
    if (AddTriangle(c[0], c[1], c[2], material, mesh)) mesh.facet.push_back(static_cast<int>(f));
    if (c[3] >= 0 && AddTriangle(c[0], c[2], c[3], material, mesh)) mesh.facet.push_back(static_cast<int>(f));
  }
  FindNeighbours(mesh);
  return mesh;
}

}  // namespace luxfit
