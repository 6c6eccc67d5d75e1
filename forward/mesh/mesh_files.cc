#include "forward/mesh/mesh_files.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "forward/mesh/internal/gltf_file.h"

namespace luxfit {

std::vector<std::string> FilesOfMesh(const std::string& path) {
  namespace fs = std::filesystem;
  std::vector<std::string> files{path};
  if (fs::path(path).extension() != ".gltf") return files;
  std::ifstream file(path, std::ios::binary);
  const nlohmann::json document = nlohmann::json::parse(file, nullptr, false);
  if (!document.is_object() || !document.contains("buffers") || !document.at("buffers").is_array())
    return files;
  for (const nlohmann::json& buffer : document.at("buffers")) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer.at("uri").is_string()) continue;
    const std::string uri = buffer.at("uri");
    if (uri.rfind("data:", 0) == 0 || uri.find("://") != std::string::npos) continue;
    const std::optional<std::string> name = PercentDecoded(uri);
    if (!name) continue;
    const fs::path beside = fs::path(path).parent_path() / *name;
    std::error_code error;
    if (fs::is_regular_file(beside, error)) files.push_back(beside.string());
  }
  return files;
}

}  // namespace luxfit
