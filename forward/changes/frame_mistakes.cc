#include "forward/changes/frame_mistakes.h"

#include <numeric>
#include <string>
#include <utility>

#include "forward/changes/pieces.h"

namespace luxfit {
namespace {

constexpr double kSamePlaceM = 1e-3;

struct NamedTurn {
  const char* as_if;
  double xx, xy, yx, yy;  // rows of the upper left of the matrix
};

constexpr NamedTurn kTurns[] = {
    {"mirrored in x", -1, 0, 0, 1},
    {"mirrored in y", 1, 0, 0, -1},
    {"turned by 180 degrees about z", -1, 0, 0, -1},
    {"exchanged in x and y", 0, 1, 1, 0},
    {"exchanged in x and y, both with the wrong sign", 0, -1, -1, 0},
    {"turned by 90 degrees about z", 0, 1, -1, 0},
    {"turned by -90 degrees about z", 0, -1, 1, 0},
};

Eigen::Affine3d About(const Eigen::Vector3d& center, const NamedTurn& turn) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() << turn.xx, turn.xy, 0, turn.yx, turn.yy, 0, 0, 0, 1;
  map.translation() = center - map.linear() * center;
  return map;
}

}  // namespace

std::vector<FrameMistake> FrameMistakesOf(const Scene& scene) {
  std::vector<FrameMistake> mistakes;
  const Eigen::AlignedBox3d bounds = scene.Bounds();
  for (const NamedTurn& turn : kTurns) {
    const Eigen::Affine3d of_middle = About(bounds.center(), turn), of_origin = About({0, 0, 0}, turn);
    mistakes.push_back({turn.as_if, of_middle, false});
    if ((of_middle.translation() - of_origin.translation()).norm() > kSamePlaceM)
      mistakes.push_back({std::string(turn.as_if) + " at the origin", of_origin, true});
  }
  return mistakes;
}

Scene WithFacetsMapped(Scene scene, const std::vector<int>& facets, const Eigen::Affine3d& map) {
  const bool is_mirror = map.linear().determinant() < 0;
  for (const int f : facets) {
    Facet& facet = scene.facets[static_cast<size_t>(f)];
    facet.origin = map * facet.origin;
    facet.edge_u = map.linear() * facet.edge_u;
    facet.edge_v = map.linear() * facet.edge_v;
    if (is_mirror) std::swap(facet.edge_u, facet.edge_v);
  }
  return scene;
}

Scene WithMeshMapped(Scene scene, const Eigen::Affine3d& map) {
  std::vector<int> all(scene.facets.size());
  std::iota(all.begin(), all.end(), 0);
  return WithFacetsMapped(std::move(scene), all, map);
}

std::vector<int> FurnitureOf(const Scene& mesh) {
  std::vector<int> furniture;
  if (!mesh.surface.empty()) return furniture;
  for (const std::vector<int>& piece : LoosePieces(mesh))
    furniture.insert(furniture.end(), piece.begin(), piece.end());
  double all_m2 = 0, furniture_m2 = 0;
  for (const Facet& facet : mesh.facets) all_m2 += facet.AreaM2();
  for (const int f : furniture) furniture_m2 += mesh.facets[static_cast<size_t>(f)].AreaM2();
  if (2 * furniture_m2 > all_m2) furniture.clear();
  return furniture;
}

Scene WithMeshMoved(Scene mesh, const MeshMove& move) {
  if (!move.is_furniture_alone) return WithMeshMapped(std::move(mesh), move.right_from_given);
  const std::vector<int> furniture = FurnitureOf(mesh);
  return WithFacetsMapped(std::move(mesh), furniture, move.right_from_given);
}

}  // namespace luxfit
