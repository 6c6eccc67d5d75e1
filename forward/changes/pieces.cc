#include "forward/changes/pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "forward/room/internal/facet_corners.h"
#include "forward/room/internal/mesh_topology.h"

namespace luxfit {
namespace {

constexpr double kOnBoxM = 1e-3;

enum class BoxSide { kOff, kFacesIn, kFacesOut };

BoxSide SideOf(const Facet& facet, const Eigen::AlignedBox3d& box) {
  const FacetCorners corners = CornersOf(facet);
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sense : {1, -1}) {
      const double plane = sense > 0 ? box.min()[axis] : box.max()[axis];
      if (std::all_of(corners.begin(), corners.end(),
                      [&](const Eigen::Vector3d& p) { return std::abs(p[axis] - plane) < kOnBoxM; }))
        return sense * facet.Normal()[axis] > 0 ? BoxSide::kFacesIn : BoxSide::kFacesOut;
    }
  }
  return BoxSide::kOff;
}

// Vertices that facets join; the first of each set stands for it.
class JoinedVertices {
 public:
  explicit JoinedVertices(size_t count) : next_(count) { std::iota(next_.begin(), next_.end(), size_t{0}); }

  size_t Of(size_t vertex) {
    while (next_[vertex] != vertex) vertex = next_[vertex] = next_[next_[vertex]];
    return vertex;
  }
  void Join(size_t a, size_t b) {
    a = Of(a), b = Of(b);
    next_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<size_t> next_;
};

}  // namespace

std::vector<std::vector<int>> LoosePieces(const Scene& scene) {
  const Eigen::AlignedBox3d box = scene.Bounds();
  const MeshTopology mesh = MakeTopology(scene);
  JoinedVertices joined(mesh.vertices.size());
  std::vector<BoxSide> sides;
  sides.reserve(scene.facets.size());
  for (const Facet& facet : scene.facets) sides.push_back(SideOf(facet, box));
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    if (sides[f] == BoxSide::kFacesIn) continue;
    for (const int vertex : mesh.corners[f])
      if (vertex >= 0) joined.Join(static_cast<size_t>(mesh.corners[f].front()), static_cast<size_t>(vertex));
  }
  std::map<size_t, std::vector<int>> by_vertex;
  for (size_t f = 0; f < scene.facets.size(); ++f)
    if (sides[f] != BoxSide::kFacesIn)
      by_vertex[joined.Of(static_cast<size_t>(mesh.corners[f].front()))].push_back(static_cast<int>(f));
  std::vector<std::vector<int>> pieces;
  for (auto& [vertex, facets] : by_vertex) {
    // A wall that is wound the wrong way is no piece.
    if (std::any_of(facets.begin(), facets.end(),
                    [&](int f) { return sides[static_cast<size_t>(f)] == BoxSide::kOff; }))
      pieces.push_back(std::move(facets));
  }
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

Eigen::AlignedBox3d BoundsOf(const Scene& scene, const std::vector<int>& facets) {
  Eigen::AlignedBox3d bounds;
  for (const int f : facets) bounds.extend(BoxOf(scene.facets[static_cast<size_t>(f)], 0));
  return bounds;
}

Scene WithoutFacets(const Scene& scene, const std::vector<int>& facets) {
  const std::set<int> out(facets.begin(), facets.end());
  Scene kept;
  kept.dropped_facets = scene.dropped_facets;
  std::map<int, int> material_of, facet_of;  // old index, new index
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    if (out.count(static_cast<int>(f)) > 0) continue;
    Facet facet = scene.facets[f];
    const auto [place, is_new] = material_of.try_emplace(facet.material, kept.materials.size());
    if (is_new) kept.materials.push_back(scene.materials[static_cast<size_t>(facet.material)]);
    facet.material = place->second;
    facet_of[static_cast<int>(f)] = static_cast<int>(kept.facets.size());
    kept.facets.push_back(facet);
  }
  for (SurfaceTriangle triangle : scene.surface) {
    const auto place = facet_of.find(triangle.facet);
    if (place == facet_of.end()) continue;
    triangle.facet = place->second;
    kept.surface.push_back(triangle);
  }
  return kept;
}

Scene WithPiecesMoved(Scene scene, const std::vector<PieceMove>& moves) {
  if (moves.empty()) return scene;
  constexpr double kSameM = 1e-3;
  std::vector<int> left_out;
  for (const std::vector<int>& piece : LoosePieces(scene)) {
    const Eigen::AlignedBox3d bounds = BoundsOf(scene, piece);
    const auto move = std::find_if(moves.begin(), moves.end(), [&](const PieceMove& m) {
      return (m.bounds.min() - bounds.min()).norm() < kSameM &&
             (m.bounds.max() - bounds.max()).norm() < kSameM;
    });
    if (move == moves.end()) continue;
    if (!move->by_m) left_out.insert(left_out.end(), piece.begin(), piece.end());
    if (move->by_m)
      for (const int f : piece) scene.facets[static_cast<size_t>(f)].origin += *move->by_m;
  }
  return left_out.empty() ? scene : WithoutFacets(scene, left_out);
}

}  // namespace luxfit
