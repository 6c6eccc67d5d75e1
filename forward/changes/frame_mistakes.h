// Lists the ways in which the frame of a mesh is mostly taken wrongly, and puts a mesh where it would be without them.
//
//   p_right = turn (p - centre) + centre       turn: a mirror, a quarter turn, or both, z stays up
//
// centre: the world's origin, or the middle of the mesh's bounds. Metres, world frame. Source: the symmetries of a square.
#ifndef LUXFIT_FORWARD_CHANGES_FRAME_MISTAKES_H_
#define LUXFIT_FORWARD_CHANGES_FRAME_MISTAKES_H_

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct FrameMistake {
  std::string as_if;                 // completes "the mesh looks ..."
  Eigen::Affine3d right_from_given;  // maps the mesh as given to where it would be
  bool is_about_origin = false;
};

// Returns the seven about the middle, and after each the same about the origin where it lies elsewhere.
std::vector<FrameMistake> FrameMistakesOf(const Scene& scene);

// Returns the scene with its facets mapped. Those that `facets` does not list stay; fronts stay fronts in a mirror.
Scene WithFacetsMapped(Scene scene, const std::vector<int>& facets, const Eigen::Affine3d& map);
Scene WithMeshMapped(Scene scene, const Eigen::Affine3d& map);

// Says where a mesh, or its furniture, is instead.
struct MeshMove {
  Eigen::Affine3d right_from_given = Eigen::Affine3d::Identity();
  bool is_furniture_alone = false;
};
// Returns the facets of furniture; none where it cannot be told from the room, as in a scan.
std::vector<int> FurnitureOf(const Scene& mesh);
Scene WithMeshMoved(Scene mesh, const MeshMove& move);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_CHANGES_FRAME_MISTAKES_H_
