#include "apps/text/file_stem.h"

#include <cctype>
#include <filesystem>
#include <set>

#include "apps/text/suggest.h"

namespace luxfit {

std::string FileName(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string FileStem(const std::string& id) {
  std::string stem = id;
  for (char& c : stem) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' || c == '_';
    if (!is_plain) c = '_';
  }
  return stem;
}

std::vector<std::string> DistinctFileStems(const std::vector<std::string>& ids) {
  std::set<std::string> taken;
  std::vector<std::string> stems;
  stems.reserve(ids.size());
  for (const std::string& id : ids) {
    const std::string plain = FileStem(id);
    std::string stem = plain;
    for (int n = 2; !taken.insert(Lowercase(stem)).second; ++n) stem = plain + "_" + std::to_string(n);
    stems.push_back(stem);
  }
  return stems;
}

}  // namespace luxfit
