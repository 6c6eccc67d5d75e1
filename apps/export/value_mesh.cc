#include "apps/export/value_mesh.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "forward/room/one_line.h"

namespace luxfit {
namespace {

constexpr int kDigits = 9;  // a float reads back as it was

template <typename Piece>
std::vector<Eigen::Vector3d> CornersOf(const Piece& piece, bool is_triangle) {
  const Eigen::Vector3d &o = piece.origin, &u = piece.edge_u, &v = piece.edge_v;
  if (is_triangle) return {o, o + u, o + v};
  return {o, o + u, o + u + v, o + v};
}

void ExpectWhole(const ValueMesh& mesh) {
  const Eigen::Index faces = static_cast<Eigen::Index>(mesh.faces.size());
  if (mesh.material.size() != mesh.faces.size())
    throw std::invalid_argument("ValueMesh: expected a material for each face");
  for (const FaceValues& value : mesh.values) {
    const bool has_space =
        std::any_of(value.name.begin(), value.name.end(), [](unsigned char c) { return std::isspace(c); });
    if (value.name.empty() || has_space)
      throw std::invalid_argument("ValueMesh: expected names without white space, got \"" + value.name +
                                  "\"");
    if (value.values.size() != faces || !value.values.allFinite())
      throw std::invalid_argument("ValueMesh: expected one finite value a face of " + value.name);
  }
}

size_t CornerCount(const ValueMesh& mesh) {
  size_t corners = 0;
  for (const auto& face : mesh.faces) corners += face.size();
  return corners;
}

// Writes names as VTK keeps texts: as the codes of their characters, each text ended by a 0.
void AddNames(const std::vector<std::string>& names, std::ostream& text) {
  text << "<FieldData><DataArray type=\"String\" Name=\"material_names\" NumberOfTuples=\"" << names.size()
       << "\" format=\"ascii\">\n";
  for (const std::string& name : names) {
    for (const char c : name) text << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
    text << "0\n";
  }
  text << "</DataArray></FieldData>\n";
}

void AddPoints(const ValueMesh& mesh, std::ostream& text) {
  text << "<Points><DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& face : mesh.faces) {
    for (const Eigen::Vector3d& p : face) text << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  text << "</DataArray></Points>\n";
}

void AddPolygons(const ValueMesh& mesh, std::ostream& text) {
  text << "<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (size_t i = 0, corners = CornerCount(mesh); i < corners; ++i) text << i << '\n';
  text << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  size_t end = 0;
  for (const auto& face : mesh.faces) text << (end += face.size()) << '\n';
  text << "</DataArray>\n</Polys>\n";
}

std::string XmlName(const std::string& name) {
  std::string out;
  for (const char c : OneLine(name)) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

ValueMesh MeshOf(const Patches& patches, const std::vector<std::string>& materials) {
  ValueMesh mesh;
  mesh.materials = materials;
  mesh.faces.reserve(patches.elements.size());
  mesh.material.reserve(patches.elements.size());
  return mesh;
}

}  // namespace

ValueMesh MeshOfElements(const Patches& patches, const std::vector<std::string>& materials) {
  ValueMesh mesh = MeshOf(patches, materials);
  for (const Element& element : patches.elements) {
    mesh.faces.push_back(CornersOf(element, patches.IsTriangle(element.patch)));
    mesh.material.push_back(patches.patches[static_cast<size_t>(element.patch)].material);
  }
  return mesh;
}

ValueMesh MeshOfPatches(const Patches& patches, const std::vector<std::string>& materials) {
  ValueMesh mesh = MeshOf(patches, materials);
  for (size_t p = 0; p < patches.patches.size(); ++p) {
    mesh.faces.push_back(CornersOf(patches.patches[p], patches.IsTriangle(static_cast<int>(p))));
    mesh.material.push_back(patches.patches[p].material);
  }
  return mesh;
}

Eigen::VectorXd PatchMeans(const Patches& patches, const Eigen::VectorXd& of_elements) {
  if (of_elements.size() != static_cast<Eigen::Index>(patches.elements.size()))
    throw std::invalid_argument("PatchMeans: expected one value an element");
  Eigen::VectorXd means(static_cast<Eigen::Index>(patches.patches.size()));
  for (size_t p = 0; p < patches.patches.size(); ++p) {
    const Patch& patch = patches.patches[p];
    double sum = 0, area_m2 = 0;
    for (int e = patch.first_element; e < patch.first_element + patch.element_count; ++e) {
      const double own_m2 = patches.elements[static_cast<size_t>(e)].area_m2;
      sum += own_m2 * of_elements[e];
      area_m2 += own_m2;
    }
    means[static_cast<Eigen::Index>(p)] = area_m2 > 0 ? sum / area_m2 : 0;
  }
  return means;
}

std::string VtpText(const ValueMesh& mesh) {
  ExpectWhole(mesh);
  std::ostringstream text;
  text.precision(kDigits);
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<PolyData>\n";
  AddNames(mesh.materials, text);
  text << "<Piece NumberOfPoints=\"" << CornerCount(mesh)
       << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
       << mesh.faces.size() << "\">\n";
  AddPoints(mesh, text);
  AddPolygons(mesh, text);
  text << "<CellData>\n<DataArray type=\"Int32\" Name=\"material\" format=\"ascii\">\n";
  for (const int material : mesh.material) text << material << '\n';
  text << "</DataArray>\n";
  for (const FaceValues& value : mesh.values) {
    text << "<DataArray type=\"Float32\" Name=\"" << XmlName(value.name) << "\" format=\"ascii\">\n";
    for (const double v : value.values) text << static_cast<float>(v) << '\n';
    text << "</DataArray>\n";
  }
  text << "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return text.str();
}

std::string PlyText(const ValueMesh& mesh, const Eigen::Matrix3Xi& rgb) {
  ExpectWhole(mesh);
  if (rgb.cols() != static_cast<Eigen::Index>(mesh.faces.size()))
    throw std::invalid_argument("PlyText: expected one colour a face");
  std::ostringstream text;
  text.precision(kDigits);
  text << "ply\nformat ascii 1.0\n";
  for (size_t m = 0; m < mesh.materials.size(); ++m)
    text << "comment material " << m << " " << OneLine(mesh.materials[m]) << "\n";
  text << "element vertex " << CornerCount(mesh)
       << "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar "
          "green\nproperty uchar blue\nelement face "
       << mesh.faces.size() << "\nproperty list uchar int vertex_indices\nproperty int material\n";
  for (const FaceValues& value : mesh.values) text << "property float " << value.name << "\n";
  text << "end_header\n";
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto colour = rgb.col(static_cast<Eigen::Index>(f));
    for (const Eigen::Vector3d& p : mesh.faces[f])
      text << p.x() << ' ' << p.y() << ' ' << p.z() << ' ' << colour[0] << ' ' << colour[1] << ' '
           << colour[2] << '\n';
  }
  size_t next = 0;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    text << mesh.faces[f].size();
    for (size_t i = 0; i < mesh.faces[f].size(); ++i) text << ' ' << next++;
    text << ' ' << mesh.material[f];
    for (const FaceValues& value : mesh.values)
      text << ' ' << static_cast<float>(value.values[static_cast<Eigen::Index>(f)]);
    text << '\n';
  }
  return text.str();
}

}  // namespace luxfit
