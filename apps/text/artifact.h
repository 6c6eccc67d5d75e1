// Files that luxfit writes: JSON artifacts that can be understood alone, put in place whole or not at all.
//
// Every artifact opens with format, version, command line and the hashes (XXH3, 128 bit) of the inputs it was
// made from. A file is written under a temporary name beside its target and renamed, so readers never see
// half of it.
//
// Throws std::runtime_error naming the path when it cannot be written or read.
#ifndef LUXFIT_APPS_TEXT_ARTIFACT_H_
#define LUXFIT_APPS_TEXT_ARTIFACT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace luxfit {

struct Provenance {
  std::string command_line;
  std::vector<std::string> inputs;  // paths
};

nlohmann::json ProvenanceJson(const std::string& format, const Provenance& provenance);

// Hexadecimal hash of a file's bytes.
std::string HashFile(const std::string& path);
std::string HashText(const std::string& text);

void WriteJson(const std::string& path, const nlohmann::json& json);
void WriteText(const std::string& path, const std::string& text);
nlohmann::json ReadJson(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_ARTIFACT_H_
