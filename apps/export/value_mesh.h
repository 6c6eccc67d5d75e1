// Writes patches or elements of a room with values on them, as meshes that other programs draw.
//
//   VTK XML PolyData (.vtp)   one array per value, by face (CellData); the materials' names as FieldData;
//                             ParaView, VisIt, PyVista
//   PLY (ASCII)               one float property per value, by face; colours by vertex; MeshLab, Blender
//
// Faces keep their order. A parallelogram has four corners, a triangle three, counter-clockwise seen from the
// front. Corners are not shared, so that a colour belongs to one face. Lengths are in metres, world frame;
// the names of values carry their units. Faces that solids stand on are whole here, whatever their free
// share.
//
// Throws std::invalid_argument for values (or colours) that are not one per face or not finite, and for names
// that are empty or hold white space.
// Source: VTK 9 documentation, "VTK XML file formats"; Turk (1994), "The PLY polygon file format".
#ifndef LUXFIT_APPS_EXPORT_VALUE_MESH_H_
#define LUXFIT_APPS_EXPORT_VALUE_MESH_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/room/patches.h"

namespace luxfit {

struct FaceValues {
  std::string name;        // with its unit, "illuminance_lx_all"
  Eigen::VectorXd values;  // one per face
};

struct ValueMesh {
  std::vector<std::vector<Eigen::Vector3d>> faces;  // corners
  std::vector<int> material;                        // by face: index into `materials`
  std::vector<std::string> materials;
  std::vector<FaceValues> values;
};

// Return the mesh without values.
ValueMesh MeshOfElements(const Patches& patches, const std::vector<std::string>& materials);
ValueMesh MeshOfPatches(const Patches& patches, const std::vector<std::string>& materials);

// Returns the means of elements over their patches, weighed by area.
Eigen::VectorXd PatchMeans(const Patches& patches, const Eigen::VectorXd& of_elements);

std::string VtpText(const ValueMesh& mesh);

// Returns the text of a PLY file. `rgb` is 3 x faces, 0..255.
std::string PlyText(const ValueMesh& mesh, const Eigen::Matrix3Xi& rgb);

}  // namespace luxfit

#endif  // LUXFIT_APPS_EXPORT_VALUE_MESH_H_
