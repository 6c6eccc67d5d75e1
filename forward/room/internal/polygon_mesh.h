// What a mesh file holds, before it becomes facets: vertices in the file's units, polygons, material names.
//
// The readers check what they read: every index is in range and every coordinate finite. They throw
// std::runtime_error("NAME:LINE: expected ..., got ...; mend") otherwise (binary files: the element instead
// of the line; glTF: the JSON pointer). Source: Wavefront, "Object files (.obj)", appendix B1 of the Advanced
// Visualizer manual; Turk (1994), "The PLY polygon file format"; Khronos Group, "glTF 2.0 specification"
// (ISO/IEC 12113:2022).
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_POLYGON_MESH_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_POLYGON_MESH_H_

#include <Eigen/Core>
#include <algorithm>
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

  // Of a name, which is added where it is new.
  int MaterialIndex(const std::string& name) {
    const auto known = std::find(materials.begin(), materials.end(), name);
    const auto index = static_cast<int>(known - materials.begin());
    if (known == materials.end()) materials.push_back(name);
    return index;
  }
};

// Name of a surface that the file gives no material.
constexpr char kDefaultMaterial[] = "DefaultMaterial";
// Triangulation takes quadratic time and more; no modeller draws such a face.
constexpr int kMaxPolygonCorners = 1024;

// `name` is for messages only.
PolygonMesh ParseObj(std::string_view text, const std::string& name);
PolygonMesh ParsePly(std::string_view bytes, const std::string& name);
// glTF 2.0, text or GLB: the triangles of one scene, turned from its y up to z up. Buffers in other files are
// looked for in `folder` and refused where it is empty. Extensions that move surfaces (compression,
// quantization, instancing), sparse accessors, skins and morph targets are refused by name.
PolygonMesh ParseGltf(std::string_view bytes, const std::string& name, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_POLYGON_MESH_H_
