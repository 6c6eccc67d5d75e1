// Scenes made of boxes: rooms seen from inside, solids seen from outside.
//
// Metres, z up. Faces in the order x-, x+, y-, y+, z- (floor), z+ (ceiling).
#ifndef LUXFIT_TESTS_SUPPORT_SCENES_H_
#define LUXFIT_TESTS_SUPPORT_SCENES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit::support {

enum class Facing { kInward, kOutward };

inline int MaterialIndex(Scene& scene, const std::string& name) {
  const auto known = std::find(scene.materials.begin(), scene.materials.end(), name);
  const int index = static_cast<int>(known - scene.materials.begin());
  if (known == scene.materials.end()) scene.materials.push_back(name);
  return index;
}

inline void AddParallelogram(Scene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
                             const Eigen::Vector3d& edge_v, const std::string& material) {
  scene.facets.push_back({FacetKind::kParallelogram, origin, edge_u, edge_v, MaterialIndex(scene, material)});
}

inline void AddTriangle(Scene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
                        const Eigen::Vector3d& edge_v, const std::string& material) {
  scene.facets.push_back({FacetKind::kTriangle, origin, edge_u, edge_v, MaterialIndex(scene, material)});
}

// `materials`: one for all faces, or six.
inline void AddBox(Scene& scene, const Eigen::AlignedBox3d& box, Facing facing,
                   const std::vector<std::string>& materials) {
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    Eigen::Vector3d origin = box.min(), u = Eigen::Vector3d::Zero(), v = u;
    u[(axis + 1) % 3] = box.sizes()[(axis + 1) % 3];
    v[(axis + 2) % 3] = box.sizes()[(axis + 2) % 3];
    const bool upper = face % 2 == 1;
    if (upper) origin[axis] = box.max()[axis];
    // u x v points along +axis: out of the box on the upper face, into it on the lower.
    if (upper == (facing == Facing::kInward)) std::swap(u, v);
    AddParallelogram(scene, origin, u, v, materials[materials.size() == 1 ? 0 : static_cast<size_t>(face)]);
  }
}

// A closed room of one material with a corner at the origin.
inline Scene ClosedRoom(const Eigen::Vector3d& size_m, const std::vector<std::string>& materials = {"wall"}) {
  Scene scene;
  AddBox(scene, {Eigen::Vector3d::Zero(), size_m}, Facing::kInward, materials);
  return scene;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_SCENES_H_
