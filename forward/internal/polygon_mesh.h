// What a mesh file holds, before it becomes facets: vertices in the file's units, polygons, material names.
//
// The readers check what they read: every index is in range and every coordinate finite. They throw
// std::runtime_error("NAME:LINE: expected ..., got ...; mend") otherwise (binary files: the element instead
// of the line). Source: Wavefront, "Object files (.obj)", appendix B1 of the Advanced Visualizer manual; Turk
// (1994), "The PLY polygon file format".
#ifndef LUXFIT_FORWARD_INTERNAL_POLYGON_MESH_H_
#define LUXFIT_FORWARD_INTERNAL_POLYGON_MESH_H_

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace luxfit {

struct PolygonMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> corners;          // of all polygons, one after the other: indices into vertices
  std::vector<size_t> first_corner;  // one a polygon
  std::vector<int> material;         // one a polygon
  std::vector<std::string> materials;

  size_t CornersEnd(size_t polygon) const {
    return polygon + 1 < first_corner.size() ? first_corner[polygon + 1] : corners.size();
  }
};

// Name of a surface that the file gives no material.
constexpr char kDefaultMaterial[] = "DefaultMaterial";
// Triangulation takes quadratic time and more; no modeller draws such a face.
constexpr int kMaxPolygonCorners = 1024;

// `name` is for messages only.
PolygonMesh ParseObj(std::string_view text, const std::string& name);
PolygonMesh ParsePly(std::string_view bytes, const std::string& name);
// glTF and GLB, by assimp; reads the file itself, because a .gltf refers to others.
PolygonMesh ReadGltf(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_INTERNAL_POLYGON_MESH_H_
