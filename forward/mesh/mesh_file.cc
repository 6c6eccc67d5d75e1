#include "forward/mesh/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "forward/mesh/internal/polygon_mesh.h"
#include "forward/room/one_line.h"
#include "forward/room/text_encoding.h"

namespace luxfit {
namespace {

constexpr double kMaxCoordinateM = 1e5;  // past it, float rays no longer see millimetres

Scene SceneOf(const PolygonMesh& mesh, const std::string& name, double metres_per_unit) {
  Scene scene;
  std::vector<int> material_of(mesh.materials.size(), -1);  // only those that a facet has
  std::vector<Eigen::Vector3d> polygon;
  for (size_t f = 0; f < mesh.first_corner.size(); ++f) {
    polygon.clear();
    for (size_t c = mesh.first_corner[f]; c < mesh.CornersEnd(f); ++c) {
      polygon.push_back(metres_per_unit * mesh.vertices[static_cast<size_t>(mesh.corners[c])]);
      if (!(polygon.back().cwiseAbs().maxCoeff() <= kMaxCoordinateM))
        throw std::runtime_error(name +
                                 ": expected a mesh within 100 km of the origin, got a vertex beyond; check "
                                 "the mesh and its unit");
    }
    if (polygon.size() < 3) continue;  // points and lines
    int& material = material_of[static_cast<size_t>(mesh.material[f])];
    const std::vector<Facet> facets =
        FacetsFromPolygon(polygon, material < 0 ? static_cast<int>(scene.materials.size()) : material);
    if (facets.empty()) {
      ++scene.dropped_facets;
      continue;
    }
    if (material < 0) {
      material = static_cast<int>(scene.materials.size());
      scene.materials.push_back(OneLine(mesh.materials[static_cast<size_t>(mesh.material[f])]));
    }
    scene.facets.insert(scene.facets.end(), facets.begin(), facets.end());
  }
  if (scene.facets.empty())
    throw std::runtime_error(name +
                             ": expected at least one facet with an area, found none; is it a mesh of "
                             "surfaces, and is the unit right?");
  return scene;
}

std::string ExtensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string BytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw std::runtime_error(path + ": expected a mesh file, got one that cannot be read");
  return bytes;
}

PolygonMesh MeshOf(std::string_view bytes, MeshFormat format, const std::string& name) {
  switch (format) {
    case MeshFormat::kObj:
      return ParseObj(Utf8Text(bytes), name);
    case MeshFormat::kPly:
      return ParsePly(bytes, name);
    case MeshFormat::kGltf:
      return ParseGltf(bytes, name, "");
  }
  return {};
}

}  // namespace

Scene ParseScene(std::string_view bytes, MeshFormat format, const std::string& name, double metres_per_unit) {
  return SceneOf(MeshOf(bytes, format, name), name, metres_per_unit);
}

Scene ReadScene(const std::string& path, double metres_per_unit) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(path + ": expected a mesh file, found none");
  const std::string extension = ExtensionOf(path);
  if (extension == ".obj") return ParseScene(BytesOf(path), MeshFormat::kObj, path, metres_per_unit);
  if (extension == ".ply") return ParseScene(BytesOf(path), MeshFormat::kPly, path, metres_per_unit);
  if (extension == ".gltf" || extension == ".glb") {
    const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
    return SceneOf(ParseGltf(BytesOf(path), path, folder.string()), path, metres_per_unit);
  }
  throw std::runtime_error(path + ": expected a mesh file .obj, .ply, .gltf or .glb, got \"" + extension +
                           "\"; export it as OBJ");
}

}  // namespace luxfit
