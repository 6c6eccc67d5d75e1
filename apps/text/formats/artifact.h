// Writes and reads the files that luxfit makes: JSON artifacts that explain themselves, written whole or not
// at all.
//
// Every artifact opens with its format, the version, the command line and the hashes of its inputs (XXH3, 128
// bit). A file is written under a temporary name beside its target and then renamed, so that readers never
// see half of it.
//
// Throws std::runtime_error naming the path where it cannot be written or read.
#ifndef LUXFIT_APPS_TEXT_FORMATS_ARTIFACT_H_
#define LUXFIT_APPS_TEXT_FORMATS_ARTIFACT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace luxfit {

struct Provenance {
  std::string command_line;
  std::vector<std::string> inputs;  // paths
};

nlohmann::json ProvenanceJson(const std::string& format, const Provenance& provenance);

// Refuses an output folder in which one of luxfit's own folders is a symbolic link: files would land elsewhere.
void ExpectOwnFolders(const std::string& out);

// Returns the hash of a file's bytes in hexadecimal.
std::string HashFile(const std::string& path);
std::string HashText(const std::string& text);

// Returns JSON of two blanks a level, with a line end. Bytes that are no UTF-8 (in names of files) become U+FFFD.
std::string JsonText(const nlohmann::json& json);

void WriteJson(const std::string& path, const nlohmann::json& json);
void WriteText(const std::string& path, const std::string& text);
nlohmann::json ReadJson(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_ARTIFACT_H_
