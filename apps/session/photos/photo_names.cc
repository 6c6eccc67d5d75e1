#include "apps/session/photos/photo_names.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "apps/text/suggest.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

bool IsEverything(const std::string& state) {
  const std::set<std::string> words = {"all", "on", "full"};
  return words.count(Lowercase(state)) > 0;
}

bool IsNothing(const std::string& state) {
  const std::set<std::string> words = {"off", "dark", "ambient", "none", "black"};
  return words.count(Lowercase(state)) > 0;
}

// Tells names of things (A, B2, lamp1, desk_spot) from names of occasions.
bool IsLuminaireName(const std::string& state) {
  const std::string lower = Lowercase(state);
  const bool has_digit = lower.find_first_of("0123456789") != std::string::npos;
  const std::vector<std::string> words = {"lamp", "light", "lum", "spot", "panel", "downlight", "tube"};
  return lower.size() <= 3 || has_digit ||
         std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return lower.find(word) != std::string::npos; });
}

struct Split {
  std::string first, last;
};

// Splits the name at the last _ or -.
Split SplitName(const std::string& stem) {
  const size_t at = stem.find_last_of("_-");
  if (at == std::string::npos || at == 0 || at + 1 == stem.size()) return {stem, ""};
  return {stem.substr(0, at), stem.substr(at + 1)};
}

std::string StemOf(const std::string& file) { return fs::path(file).stem().string(); }

bool IsNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// Tells the running numbers and times of cameras: 0001, 0001a, 123456789.MP. States have no such names.
bool IsCameraNumber(const std::string& text) {
  constexpr size_t kDigits = 4;
  return IsNumber(text) || text.find_first_not_of("0123456789") >= kDigits;
}

enum class Brackets { kNone, kAllowed };

// Tells whether at least half of the photos share their view with another. Without brackets, no two share both view and
// state.
bool IsOfSharedViews(const std::vector<NamedPhoto>& photos, Brackets brackets = Brackets::kNone) {
  std::map<std::string, size_t> of_view;
  std::set<std::pair<std::string, std::string>> pairs;
  for (const NamedPhoto& photo : photos) {
    if (photo.state.empty() || IsCameraNumber(photo.state)) return false;
    ++of_view[photo.view];
    if (!pairs.insert({photo.view, photo.state}).second && brackets == Brackets::kNone) return false;
  }
  // With all of one view and state, the names tell neither: 20240501_HDR_1, 20240501_HDR_2.
  if (brackets == Brackets::kAllowed && pairs.size() < 2) return false;
  size_t sharing = 0;
  for (const auto& [view, count] : of_view) sharing += count > 1 ? count : 0;
  return 2 * sharing >= photos.size() && sharing > 0;
}

std::vector<NamedPhoto> ByFolder(const std::vector<std::string>& files) {
  std::vector<NamedPhoto> photos;
  photos.reserve(files.size());
  for (const std::string& file : files)
    photos.push_back({file, StemOf(file), fs::path(file).parent_path().filename().string()});
  return photos;
}

// Tells whether the folders are called as views are, or the files as states.
bool DoFoldersNameViews(const std::vector<NamedPhoto>& by_folder) {
  const std::regex view(R"((v|view|pose|pos|position|place|tripod)?[ _-]?[0-9]+)");
  const std::regex of_camera("[0-9]{3}|^(img|dsc|pxl|photo|foto|image|frame)", std::regex::icase);
  bool are_views = true, are_files_states = false, are_folders_states = false;
  for (const NamedPhoto& photo : by_folder) {
    are_views = are_views && std::regex_match(Lowercase(photo.state), view) &&
                !std::regex_search(photo.view, of_camera);
    are_files_states = are_files_states || IsEverything(photo.view) || IsNothing(photo.view);
    are_folders_states = are_folders_states || IsEverything(photo.state) || IsNothing(photo.state);
  }
  return are_views || (are_files_states && !are_folders_states);
}

// Returns the name without the number of an exposure: "v00_A" of "v00_A_1". Numbers of cameras have more digits.
std::string WithoutExposure(const std::string& stem) {
  constexpr size_t kMostDigits = 2;
  const Split split = SplitName(stem);
  return IsNumber(split.last) && split.last.size() <= kMostDigits ? split.first : stem;
}

std::vector<NamedPhoto> ByFolderOfView(std::vector<NamedPhoto> by_folder) {
  for (NamedPhoto& photo : by_folder) {
    std::swap(photo.view, photo.state);
    photo.state = WithoutExposure(photo.state);
  }
  return by_folder;
}

std::vector<NamedPhoto> ByName(const std::vector<std::string>& files, Brackets brackets) {
  std::vector<NamedPhoto> photos;
  bool is_state_first = true;
  for (const std::string& file : files) {
    const std::string stem = StemOf(file);
    const Split split = SplitName(brackets == Brackets::kAllowed ? WithoutExposure(stem) : stem);
    photos.push_back({file, split.first, split.last});
  }
  is_state_first = std::any_of(photos.begin(), photos.end(),
                               [](const NamedPhoto& p) { return IsEverything(p.view) || IsNothing(p.view); });
  for (NamedPhoto& photo : photos) {
    if (is_state_first) std::swap(photo.view, photo.state);
  }
  return photos;
}

}  // namespace

bool IsDoubtful(const NamedPhoto& photo) { return photo.note.rfind("CHECK", 0) == 0; }

PhotoNames GuessViewsAndStates(const std::vector<std::string>& files) {
  PhotoNames names{ByFolder(files), "the folder names the state, the file the view"};
  if (DoFoldersNameViews(names.photos)) {
    PhotoNames turned{ByFolderOfView(names.photos), "the folder names the view, the file the state"};
    if (IsOfSharedViews(turned.photos, Brackets::kAllowed)) return turned;
  }
  if (IsOfSharedViews(names.photos)) return names;
  names = {ByName(files, Brackets::kNone), "names are VIEW_STATE"};
  if (IsOfSharedViews(names.photos)) return names;
  names = {ByName(files, Brackets::kAllowed), "names are VIEW_STATE_EXPOSURE"};
  if (IsOfSharedViews(names.photos, Brackets::kAllowed)) return names;
  names = {{}, "nothing in the names tells views from states: each photo a view, all in one state", false};
  names.photos.reserve(files.size());
  for (const std::string& file : files) names.photos.push_back({file, StemOf(file), "all"});
  return names;
}

std::vector<GuessedState> GuessStates(const PhotoNames& names) {
  std::set<std::string> ids, luminaires, occasions;
  for (const NamedPhoto& photo : names.photos) ids.insert(photo.state);
  for (const std::string& id : ids) {
    if (!IsEverything(id) && !IsNothing(id)) (IsLuminaireName(id) ? luminaires : occasions).insert(id);
  }
  if (luminaires.empty()) luminaires.swap(occasions);
  std::vector<GuessedState> states;
  states.reserve(ids.size());
  for (const std::string& id : ids) {
    if (luminaires.count(id) > 0) {
      states.push_back({id, {id}});
    } else if (IsNothing(id)) {
      states.push_back({id, {}});
    } else {
      states.push_back({id, {luminaires.begin(), luminaires.end()}});
      states.back().is_occasion = !IsEverything(id);
    }
  }
  return states;
}

}  // namespace luxfit
