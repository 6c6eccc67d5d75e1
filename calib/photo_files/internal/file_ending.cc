#include "calib/photo_files/internal/file_ending.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace luxfit {

std::string FileEnding(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace luxfit
