#include "apps/text/formats/artifact.h"

#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/version.h"

namespace luxfit {
namespace {

std::string Hexadecimal(const XXH128_hash_t& hash) {
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text.data();
}

}  // namespace

std::string HashFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": expected a readable file");
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> buffer(1 << 16);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0) {
    XXH3_128bits_update(state.get(), buffer.data(), static_cast<size_t>(file.gcount()));
  }
  return Hexadecimal(XXH3_128bits_digest(state.get()));
}

std::string HashText(const std::string& text) { return Hexadecimal(XXH3_128bits(text.data(), text.size())); }

nlohmann::json ProvenanceJson(const std::string& format, const Provenance& provenance) {
  nlohmann::json opening;
  opening["format"] = format;
  opening["luxfit_version"] = kVersion;
  opening["command"] = provenance.command_line;
  opening["inputs"] = nlohmann::json::object();
  for (const std::string& input : provenance.inputs) opening["inputs"][input] = HashFile(input);
  return opening;
}

void ExpectOwnFolders(const std::string& out) {
  std::error_code error;
  for (const char* name : {"stages", "luminaires", "export"}) {
    const std::filesystem::path folder = std::filesystem::path(out) / name;
    if (std::filesystem::is_symlink(folder, error))
      throw std::runtime_error(
          folder.string() +
          ": expected a folder that luxfit made, got a symbolic link; remove it, or name "
          "another folder by --out");
  }
}

void WriteText(const std::string& path, const std::string& text) {
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
  const std::string temporary = path + ".part" + std::to_string(getpid());
  {
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
      std::filesystem::remove(temporary, error);
      throw std::runtime_error(path + ": expected a writable place; check the folder and the free space");
    }
  }
  std::filesystem::rename(temporary, path);
}

std::string JsonText(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void WriteJson(const std::string& path, const nlohmann::json& json) { WriteText(path, JsonText(json)); }

nlohmann::json ReadJson(const std::string& path) {
  std::ifstream file(path);
  std::error_code error;
  if (!file || std::filesystem::is_directory(path, error))
    throw std::runtime_error(path + ": expected a readable file, found none");
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::parse_error& e) {
    throw std::runtime_error(path + ": expected JSON, got something else at byte " + std::to_string(e.byte) +
                             "; run the command that wrote the file again");
  } catch (const nlohmann::json::out_of_range&) {
    throw std::runtime_error(path + ": expected numbers of up to 1e308, got a larger one");
  }
}

}  // namespace luxfit
