#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "forward/internal/polygon_mesh.h"

namespace luxfit {
namespace {

// assimp reads past the end of a GLB whose header promises more than the file holds.
void ExpectWholeGlb(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 12> header{};
  file.read(header.data(), header.size());
  uint32_t version = 0, length = 0;
  std::memcpy(&version, header.data() + 4, 4);
  std::memcpy(&length, header.data() + 8, 4);
  if (!file || std::string_view(header.data(), 4) != "glTF" || version != 2)
    throw std::runtime_error(path +
                             ": expected a GLB file of version 2, got another header; export it again");
  const uintmax_t size = std::filesystem::file_size(path);
  if (length > size)
    throw std::runtime_error(path + ": expected " + std::to_string(length) +
                             " bytes as its header says, got " + std::to_string(size) +
                             "; the file is truncated");
}

}  // namespace

PolygonMesh ReadGltf(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".glb") ExpectWholeGlb(path);
  Assimp::Importer importer;
  // PreTransformVertices bakes the node transforms in; faces keep their number of corners. Validation comes
  // first and refuses indices out of range.
  const aiScene* file =
      importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_PreTransformVertices);
  if (file == nullptr)
    throw std::runtime_error(path + ": expected a glTF mesh; " + importer.GetErrorString());
  PolygonMesh result;
  for (unsigned m = 0; m < file->mNumMeshes; ++m) {
    const aiMesh& mesh = *file->mMeshes[m];
    const std::string name = file->mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    const auto known = std::find(result.materials.begin(), result.materials.end(), name);
    const int material = static_cast<int>(known - result.materials.begin());
    if (known == result.materials.end()) result.materials.push_back(name);
    const int base = static_cast<int>(result.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      result.vertices.emplace_back(p.x, p.y, p.z);
      if (!result.vertices.back().allFinite())
        throw std::runtime_error(path +
                                 ": expected finite vertices, got one that is not; export the mesh again");
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices > static_cast<unsigned>(kMaxPolygonCorners))
        throw std::runtime_error(path + ": expected faces of at most " + std::to_string(kMaxPolygonCorners) +
                                 " corners; triangulate the mesh");
      result.first_corner.push_back(result.corners.size());
      result.material.push_back(material);
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices)
          throw std::runtime_error(
              path + ": expected indices of vertices, got one out of range; export the mesh again");
        result.corners.push_back(base + static_cast<int>(face.mIndices[k]));
      }
    }
  }
  return result;
}

}  // namespace luxfit
