// Holds the content of a mesh file before it becomes facets: vertices, polygons, material names.
//
// Vertices are in the file's units. The readers check that every index is in range and every coordinate
// finite. They throw std::runtime_error("NAME:LINE: expected ..., got ...; remedy") otherwise; messages name
// the element instead of the line for binary files, and the JSON pointer for glTF.
//
// Source: Wavefront, "Object files (.obj)", appendix B1 of the Advanced Visualizer manual; Turk (1994), "The
// PLY polygon file format"; Khronos Group, "glTF 2.0 specification" (ISO/IEC 12113:2022).
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_POLYGON_MESH_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_POLYGON_MESH_H_

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct PolygonMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> corners;          // indices into vertices, polygon after polygon
  std::vector<size_t> first_corner;  // one per polygon
  std::vector<int> material;         // one per polygon
  std::vector<std::string> materials;

  size_t CornersEnd(size_t polygon) const {
    return polygon + 1 < first_corner.size() ? first_corner[polygon + 1] : corners.size();
  }

  // Returns the index of a name, which is added where it is new.
  int MaterialIndex(const std::string& name) {
    const auto known = std::find(materials.begin(), materials.end(), name);
    const auto index = static_cast<int>(known - materials.begin());
    if (known == materials.end()) materials.push_back(name);
    return index;
  }
};

// Names the material of a surface to which the file gives none.
// Triangulation takes quadratic time and more; no modeller draws such a face.
constexpr int kMaxPolygonCorners = 1024;

inline bool IsMeshBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; }

// Cuts the next word off the front of a line; empty at its end.
inline std::string_view NextWord(std::string_view& line) {
  while (!line.empty() && IsMeshBlank(line.front())) line.remove_prefix(1);
  size_t length = 0;
  while (length < line.size() && !IsMeshBlank(line[length])) ++length;
  const std::string_view word = line.substr(0, length);
  line.remove_prefix(length);
  return word;
}

// Parse a file; messages call it `name`.
PolygonMesh ParseObj(std::string_view text, const std::string& name);
PolygonMesh ParsePly(std::string_view bytes, const std::string& name);
// Parses glTF 2.0, text or GLB: the triangles of one scene, turned from its y up to z up. Buffers in other
// files are read from `folder` and refused where it is empty. Extensions that move surfaces (compression,
// quantization, instancing), sparse accessors, skins and morph targets are refused by name.
PolygonMesh ParseGltf(std::string_view bytes, const std::string& name, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_POLYGON_MESH_H_
