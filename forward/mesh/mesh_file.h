// Reads a room's geometry from OBJ, PLY and glTF/GLB files.
//
// Lengths are multiplied by metres_per_unit. OBJ and PLY do not state their axes and are read as z up. glTF is
// y up: its (x, y, z) becomes (x, -z, y). Rectangles of a file stay whole; every other polygon becomes
// triangles. Materials are those that the file names (OBJ usemtl). A surface without one has the material
// "DefaultMaterial"; material number N of a glTF file without a name is "material_N". Polygons without area
// are left out and counted.
//
// Throws std::runtime_error("FILE:LINE: expected ..., got ...; remedy") for a file that cannot be read or is
// truncated, has an index out of range or a coordinate that is no number. Throws it too for a mesh more than
// 100 km from the origin, faces of more than 1024 corners, or no facet with an area. Messages give no line
// for binary files and the JSON pointer for glTF. A glTF file is also refused for features that are not read:
// extensions that move surfaces, sparse accessors, skins, morph targets, more than four million triangles.
// Source of the readers: see forward/mesh/internal/polygon_mesh.h.
#ifndef LUXFIT_FORWARD_MESH_MESH_FILE_H_
#define LUXFIT_FORWARD_MESH_MESH_FILE_H_

#include <string>
#include <string_view>

#include "forward/room/scene.h"

namespace luxfit {

Scene ReadScene(const std::string& path, double metres_per_unit = 1.0);

// Reads a mesh that is a single file from memory; messages call it `name`. kGltf: text or GLB.
enum class MeshFormat { kObj, kPly, kGltf };
Scene ParseScene(std::string_view bytes, MeshFormat format, const std::string& name,
                 double metres_per_unit = 1.0);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_MESH_FILE_H_
