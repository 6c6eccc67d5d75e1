#include "apps/commands/internal/photo_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "apps/session/session_files.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

struct OtherFiles {
  std::string kind, remedy;
  std::set<std::string> endings;
};

// Kinds of files that people take for photos, with what makes photos of them.
const std::vector<OtherFiles>& KindsOfOtherFiles() {
  static const std::vector<OtherFiles> kinds = {
      {"AVIF, WebP or JPEG XL",
       "convert them to PNG or JPEG: convert IMG.webp IMG.png",
       {".avif", ".webp", ".jxl"}},
      {"movies",
       "extract frames: ffmpeg -i MOVIE -vf fps=1 frame_%04d.png; better take photos, whose exposure is "
       "known",
       {".mov", ".mp4", ".m4v", ".avi", ".mkv", ".webm", ".3gp", ".mts"}},
      {"GIF, BMP, PSD or PDF",
       "export the photos again as PNG, TIFF or JPEG from the camera's files",
       {".gif", ".bmp", ".psd", ".pdf"}},
      {"archives", "unpack them: unzip FILE -d photos", {".zip", ".tar", ".gz", ".tgz", ".7z", ".rar"}},
      {"RAW of a kind that is not read",
       "convert them to DNG, or develop them linearly to 16-bit TIFF",
       {".x3f", ".mrw", ".erf", ".gpr", ".rwl", ".raw"}}};
  return kinds;
}

// Says what lies in the folder: "movies: 2 (IMG_1.MOV, ...)", with remedies.
std::string WhatLiesThere(const std::vector<std::string>& files) {
  if (files.empty()) return "found no files at all; give the folder that holds the photos";
  std::map<size_t, std::vector<std::string>> by_kind;
  const std::vector<OtherFiles>& kinds = KindsOfOtherFiles();
  for (const std::string& file : files) {
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const OtherFiles& other) {
      return other.endings.count(ExtensionOf(file)) > 0;
    });
    by_kind[static_cast<size_t>(kind - kinds.begin())].push_back(file);
  }
  std::vector<std::string> found, remedies;
  for (const auto& [kind, of_kind] : by_kind) {
    const std::string name = kind < kinds.size() ? kinds[kind].kind : "other files";
    found.push_back(fmt::format("{}: {} ({}{})", name, of_kind.size(), of_kind.front(),
                                of_kind.size() > 1 ? ", ..." : ""));
    if (kind < kinds.size()) remedies.push_back(kinds[kind].remedy);
  }
  if (remedies.empty()) remedies.emplace_back("give the folder that holds the photos");
  return fmt::format("found {}; {}", fmt::join(found, ", "), fmt::join(remedies, "; "));
}

}  // namespace

bool IsPhotoName(const std::string& path) {
  static const std::set<std::string> endings = {
      ".png", ".tif", ".tiff", ".exr", ".jpg", ".jpeg", ".heic", ".heif", ".hif", ".dng", ".cr2", ".cr3",
      ".crw", ".nef", ".nrw",  ".arw", ".sr2", ".raf",  ".orf",  ".rw2",  ".pef", ".srw", ".iiq", ".3fr"};
  return endings.count(ExtensionOf(path)) > 0;
}

std::vector<std::string> PhotoFilesIn(const std::string& folder, const std::string& flag) {
  std::vector<std::string> photos, others;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    // Systems leave files of their own beside photos: .DS_Store, ._IMG_1234.jpg.
    if (!entry.is_regular_file() || entry.path().filename().string()[0] == '.') continue;
    (IsPhotoName(entry.path().string()) ? photos : others)
        .push_back(fs::relative(entry.path(), folder).string());
  }
  std::sort(photos.begin(), photos.end());
  std::sort(others.begin(), others.end());
  if (photos.empty())
    throw std::runtime_error(folder + ": " + flag + ": expected photos (PNG, TIFF, EXR, JPEG, HEIC, RAW), " +
                             WhatLiesThere(others));
  return photos;
}

}  // namespace luxfit
