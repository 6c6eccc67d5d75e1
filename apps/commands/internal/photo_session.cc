#include "apps/commands/internal/photo_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "apps/commands/internal/photo_files.h"
#include "apps/session/session_files.h"
#include "apps/stages/calibrate/board_text.h"
#include "apps/stages/calibrate/calibration_sets.h"
#include "apps/text/file_stem.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

constexpr char kNamePhotos[] = "PHOTO";

bool IsSessionName(const std::string& path) { return ExtensionOf(path) == ".toml"; }

// Returns the absolute paths of all photos that the inputs name, each once, sorted.
std::set<std::string> PhotosOf(const std::vector<std::string>& inputs) {
  std::set<std::string> photos;
  std::error_code error;
  for (const std::string& input : inputs) {
    if (IsSessionName(input))
      throw std::runtime_error(
          input + ": expected photos beside other photos, got a session; name the session alone");
    if (!fs::is_directory(input, error)) {
      photos.insert(AbsolutePath(FindFile({input, 0}, kNamePhotos, "", input)));
      continue;
    }
    for (const std::string& file : PhotoFilesIn(input, kNamePhotos))
      photos.insert(AbsolutePath((fs::path(input) / file).string()));
  }
  return photos;
}

struct CameraPhotos {
  std::string name;
  std::vector<std::string> files;
};

std::vector<std::vector<std::string>> FilesOf(const std::vector<CameraPhotos>& cameras) {
  std::vector<std::vector<std::string>> files;
  files.reserve(cameras.size());
  for (const CameraPhotos& camera : cameras) files.push_back(camera.files);
  return files;
}

// Returns the part of a file's name before its last number, without the signs that join them: "left" of left_01.jpg.
std::string PrefixOf(const std::string& file) {
  std::string stem = fs::path(file).stem().string();
  const std::size_t last_digit = stem.find_last_of("0123456789");
  if (last_digit == std::string::npos) return stem;
  const std::size_t before = stem.find_last_not_of("0123456789", last_digit);
  const std::string prefix = before == std::string::npos ? "" : stem.substr(0, before + 1);
  const std::size_t end = prefix.find_last_not_of("_-. ");
  return end == std::string::npos ? prefix : prefix.substr(0, end + 1);
}

template <typename NameOf>
std::vector<CameraPhotos> GroupedBy(const std::vector<std::string>& files, NameOf name_of) {
  std::map<std::string, CameraPhotos> cameras;
  for (const std::string& file : files) {
    CameraPhotos& camera = cameras[name_of(file)];
    camera.name = name_of(file);
    camera.files.push_back(file);
  }
  std::vector<CameraPhotos> out;
  out.reserve(cameras.size());
  for (auto& [name, camera] : cameras) out.push_back(std::move(camera));
  return out;
}

std::vector<CameraPhotos> CamerasOfPhotos(const std::set<std::string>& photos) {
  const std::vector<std::string> files(photos.begin(), photos.end());
  std::vector<CameraPhotos> folders =
      GroupedBy(files, [](const std::string& file) { return fs::path(file).parent_path().string(); });
  if (folders.size() == 1) {
    std::vector<CameraPhotos> prefixes = GroupedBy(files, PrefixOf);
    if (PairImages(FilesOf(prefixes), "auto").is_rig) return prefixes;
  }
  for (CameraPhotos& folder : folders) folder.name = FileName(folder.name);
  return folders;
}

// Returns the rule that a session of these cameras has.
std::string RuleFor(const std::vector<std::vector<std::string>>& files, const std::string& asked) {
  if (!asked.empty() && asked != "auto") return asked;
  const auto has_as_many = [&](const std::vector<std::string>& own) {
    return own.size() == files.front().size();
  };
  const bool by_order =
      std::all_of(files.begin(), files.end(), has_as_many) && !PairImages(files, "auto").is_rig;
  return by_order ? "order" : "auto";
}

}  // namespace

bool IsSessionFile(const std::vector<std::string>& inputs, const std::string& board) {
  if (inputs.size() != 1 || IsPhotoName(inputs.front())) return false;
  std::error_code error;
  if (!fs::is_directory(inputs.front(), error)) return true;
  // The reader of sessions names the file in the folder.
  return board.empty() && fs::exists(fs::path(inputs.front()) / "session.toml", error);
}

Session SessionOfPhotos(const std::vector<std::string>& inputs, const std::string& board,
                        const std::string& rig) {
  if (board.empty())
    throw std::runtime_error(
        "--board: expected what the photos show, got none; such as --board chessboard:9x6:0.025 (inner "
        "corners, side of a square in m)");
  if (const std::vector<std::string> rules = RigRules();
      !rig.empty() && std::find(rules.begin(), rules.end(), rig) == rules.end())
    throw std::runtime_error("--rig: " + ExpectedOneOf(rules, rig));
  const Board shown = BoardFromArgument(board);
  const std::set<std::string> photos = PhotosOf(inputs);
  const std::vector<CameraPhotos> cameras = CamerasOfPhotos(photos);
  std::vector<std::string> names;
  names.reserve(cameras.size());
  for (const CameraPhotos& camera : cameras) names.push_back(camera.name);
  const std::vector<std::string> ids = DistinctFileStems(names);
  Session session;
  session.name = fmt::format("{}", fmt::join(ids, ", "));
  session.input_files.assign(photos.begin(), photos.end());
  session.calibration.rig = RuleFor(FilesOf(cameras), rig);
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    SessionCamera camera;
    camera.id = ids[c];
    camera.board = shown;
    camera.calibration_images = cameras[c].files;
    session.cameras.push_back(std::move(camera));
  }
  return session;
}

}  // namespace luxfit
