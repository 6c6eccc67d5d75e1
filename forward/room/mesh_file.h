// Mesh files: OBJ, PLY and glTF/GLB as a scene.
//
// Lengths of the file are multiplied by metres_per_unit. Materials are those of the file's names (OBJ
// usemtl); a surface without one has the material "DefaultMaterial", number N of a glTF file without a name
// "material_N". Polygons become facets by FacetsFromPolygon; those without area are left out and counted.
//
// OBJ and PLY say nothing of axes and are taken as z up. glTF is y up: its (x, y, z) becomes (x, -z, y).
//
// Throws std::runtime_error("FILE:LINE: expected ..., got ...; mend") for a file that cannot be read, is
// truncated, has an index out of range or a coordinate that is no number, lies more than 100 km from the
// origin, has faces of more than 1024 corners, or has no facet with an area. No line for binary files, the
// JSON pointer for glTF, which also throws for what it has and this does not read: extensions that move
// surfaces, sparse accessors, skins, morph targets, more than four million triangles.
// Source: see forward/room/internal/polygon_mesh.h.
#ifndef LUXFIT_FORWARD_ROOM_MESH_FILE_H_
#define LUXFIT_FORWARD_ROOM_MESH_FILE_H_

#include <string>
#include <string_view>

#include "forward/room/scene.h"

namespace luxfit {

Scene ReadScene(const std::string& path, double metres_per_unit = 1.0);

// The same from memory, so from one file; `name` is for messages. kGltf: text or GLB.
enum class MeshFormat { kObj, kPly, kGltf };
Scene ParseScene(std::string_view bytes, MeshFormat format, const std::string& name,
                 double metres_per_unit = 1.0);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_MESH_FILE_H_
