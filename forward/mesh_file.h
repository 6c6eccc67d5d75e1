// Mesh files: OBJ, PLY and glTF/GLB as a scene.
//
// Lengths of the file are multiplied by metres_per_unit. Materials are those of the file's names (OBJ
// usemtl); a surface without one has the material "DefaultMaterial". Polygons become facets by
// FacetsFromPolygon; those without area are left out and counted.
//
// Throws std::runtime_error("FILE:LINE: expected ..., got ...; mend") for a file that cannot be read, is
// truncated, has an index out of range or a coordinate that is no number, lies more than 100 km from the
// origin, has faces of more than 1024 corners, or has no facet with an area. No line for binary files.
// Source: see forward/internal/polygon_mesh.h; Khronos Group, "glTF 2.0 specification" (ISO/IEC 12113).
#ifndef LUXFIT_FORWARD_MESH_FILE_H_
#define LUXFIT_FORWARD_MESH_FILE_H_

#include <string>
#include <string_view>

#include "forward/scene.h"

namespace luxfit {

Scene ReadScene(const std::string& path, double metres_per_unit = 1.0);

// The same from memory; `name` is for messages.
enum class MeshFormat { kObj, kPly };
Scene ParseScene(std::string_view bytes, MeshFormat format, const std::string& name,
                 double metres_per_unit = 1.0);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_FILE_H_
