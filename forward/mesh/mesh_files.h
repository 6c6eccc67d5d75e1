// Names the files that a mesh consists of: what a change of must be noticed.
#ifndef LUXFIT_FORWARD_MESH_MESH_FILES_H_
#define LUXFIT_FORWARD_MESH_MESH_FILES_H_

#include <string>
#include <vector>

namespace luxfit {

// Returns the mesh file, and after it the buffers of a glTF that lie beside it and exist. Throws for no fault of the file:
// reading the mesh names it.
std::vector<std::string> FilesOfMesh(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_MESH_FILES_H_
