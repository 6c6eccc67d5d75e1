#include "apps/session/photos/photo_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

#include "apps/session/photos/internal/match_states.h"
#include "apps/session/photos/internal/name_states.h"
#include "apps/session/photos/internal/same_state.h"
#include "apps/session/photos/internal/same_view.h"

namespace luxfit {
namespace {

// Compares numbers in names by their value: IMG_99 comes before IMG_100.
bool IsNaturallyBefore(const std::string& a, const std::string& b) {
  const auto digits = [](const std::string& text, size_t at) {
    size_t end = at;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
    return end - at;
  };
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const size_t of_a = digits(a, i), of_b = digits(b, j);
    if (of_a > 0 && of_b > 0) {
      const std::string x = a.substr(i, of_a), y = b.substr(j, of_b);
      const size_t zeros_x = std::min(x.find_first_not_of('0'), x.size());
      const size_t zeros_y = std::min(y.find_first_not_of('0'), y.size());
      const auto key = [](const std::string& text, size_t zeros) {
        return std::pair(text.size() - zeros, text.substr(zeros));
      };
      if (key(x, zeros_x) != key(y, zeros_y)) return key(x, zeros_x) < key(y, zeros_y);
      i += of_a;
      j += of_b;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

// Returns the photos by their time, or by their names where one of them states no time.
std::vector<size_t> OrderOfCapture(const std::vector<PhotoLook>& photos) {
  const bool have_times = std::all_of(
      photos.begin(), photos.end(), [](const PhotoLook& photo) { return photo.capture.taken_s.has_value(); });
  std::vector<size_t> order(photos.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) {
    const PhotoLook &a = photos[i], &b = photos[j];
    if (have_times && *a.capture.taken_s != *b.capture.taken_s)
      return *a.capture.taken_s < *b.capture.taken_s;
    return IsNaturallyBefore(a.file, b.file);
  });
  return order;
}

// Groups the photos of each view by state, in the order of capture. Sets which photos are doubtful.
std::vector<LightGroup> GroupsOf(const std::vector<PhotoLook>& photos, const std::vector<PoseGuess>& poses,
                                 std::vector<bool>& is_doubtful) {
  std::map<int, std::vector<size_t>> of_view;
  for (size_t i = 0; i < photos.size(); ++i) of_view[poses[i].view].push_back(i);
  std::vector<LightGroup> groups;
  for (const auto& [view, members] : of_view) {
    std::vector<const PhotoLook*> looks;
    looks.reserve(members.size());
    for (const size_t i : members) looks.push_back(&photos[i]);
    std::map<int, LightGroup> by_state;
    const std::vector<StateOfPhoto> states = GroupByLight(looks);
    for (size_t k = 0; k < members.size(); ++k) {
      LightGroup& group = by_state[states[k].state];
      group.view = view;
      group.photos.push_back(members[k]);
      is_doubtful[members[k]] = states[k].is_doubtful;
    }
    std::vector<LightGroup*> of_this_view;
    of_this_view.reserve(by_state.size());
    for (auto& [state, group] : by_state) of_this_view.push_back(&group);
    MeasureTagLight(photos, of_this_view);
    for (auto& [state, group] : by_state) groups.push_back(std::move(group));
  }
  std::sort(groups.begin(), groups.end(),
            [](const LightGroup& a, const LightGroup& b) { return a.photos.front() < b.photos.front(); });
  return groups;
}

std::string FolderOf(const std::string& file) {
  return std::filesystem::path(file).parent_path().filename().string();
}

// Renames what a member of the photos says by their folders, where nine in ten photos agree that there is one folder for
// each name.
bool AdoptFolders(std::vector<NamedPhoto>& photos, std::string NamedPhoto::*member) {
  constexpr double kAgreeing = 0.9;
  std::map<std::string, std::map<std::string, int>> counts;  // by folder, then by name
  for (const NamedPhoto& photo : photos) ++counts[FolderOf(photo.file)][photo.*member];
  std::set<std::string> names;
  int agreeing = 0;
  for (const auto& [folder, by_name] : counts) {
    const auto most = std::max_element(by_name.begin(), by_name.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (folder.empty() || !names.insert(most->first).second) return false;
    agreeing += most->second;
  }
  if (counts.size() < 2 || agreeing < kAgreeing * static_cast<double>(photos.size())) return false;
  for (NamedPhoto& photo : photos) photo.*member = FolderOf(photo.file);
  return true;
}

std::vector<int> CamerasOf(const std::vector<PhotoLook>& photos) {
  std::map<std::pair<std::string, std::pair<int, int>>, int> number;
  std::vector<int> cameras;
  cameras.reserve(photos.size());
  for (const PhotoLook& photo : photos)
    cameras.push_back(
        number
            .emplace(std::pair(photo.capture.camera, std::pair(photo.width_px, photo.height_px)),
                     static_cast<int>(number.size()))
            .first->second);
  return cameras;
}

std::string ViewNote(const PoseGuess& pose) {
  if (pose.tags > 0)
    return fmt::format("view: {} tag{} at the same pixels", pose.tags, pose.tags > 1 ? "s" : "");
  return pose.agreement > 0 ? "view: edges at the same pixels"
                            : "view: no other photo shows its tags or edges so";
}

// Says why a photo has its view and state, doubts first.
std::string NoteOf(const PoseGuess& pose, bool is_state_doubtful, const std::string& doubt,
                   size_t exposures) {
  std::vector<std::string> doubts;
  if (!pose.doubt.empty()) doubts.push_back("view? " + pose.doubt);
  if (is_state_doubtful) doubts.emplace_back("state? its light is nearly that of another photo of its view");
  if (!doubt.empty()) doubts.push_back("state? " + doubt);
  std::string note = doubts.empty() ? "" : fmt::format("CHECK {}; ", fmt::join(doubts, "; "));
  note += ViewNote(pose) + (doubt.empty() ? "; state: pattern of its light" : "");
  return exposures > 1 ? note + fmt::format("; one of {} exposures", exposures) : note;
}

GroupedPhotos GroupInOrder(const std::vector<PhotoLook>& photos) {
  const std::vector<PoseGuess> poses = GroupByPose(photos);
  std::vector<bool> is_doubtful(photos.size());
  const std::vector<LightGroup> groups = GroupsOf(photos, poses, is_doubtful);
  const MatchedStates matched = MatchStates(groups);
  GroupedPhotos result;
  result.states = NameStates(photos, groups, matched.state);
  result.camera = CamerasOf(photos);
  result.names.photos.resize(photos.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    for (const size_t i : groups[g].photos) {
      const std::string& state = result.states[static_cast<size_t>(matched.state[g])].id;
      const std::string note = NoteOf(poses[i], is_doubtful[i], matched.doubt[g], groups[g].photos.size());
      result.names.photos[i] = {photos[i].file, fmt::format("v{:02}", poses[i].view), state, note};
    }
  }
  result.names.because =
      "by what the photos show: tags and edges at the same pixels are a view, one pattern of light is a "
      "state; " +
      matched.because;
  return result;
}

// Names views and states by folders. States named so keep what is on in them.
void NameByFolders(GroupedPhotos& grouped, const std::vector<PhotoLook>& photos) {
  if (AdoptFolders(grouped.names.photos, &NamedPhoto::view)) {
    grouped.names.because += "; the folders name the views";
    return;
  }
  if (!AdoptFolders(grouped.names.photos, &NamedPhoto::state)) return;
  grouped.names.because += "; the folders name the states";
  grouped.states = StatesByNamesAndLight(grouped.names, photos);
}

struct NamedGroups {
  std::vector<LightGroup> groups;
  std::vector<int> state;  // of each group, as an index of the states
};

// Groups photos by the views and states of their names. Only photos of one size, and of stated exposure, can be compared.
NamedGroups GroupsByName(const PhotoNames& names, const std::vector<PhotoLook>& photos,
                         const std::vector<GuessedState>& states) {
  std::map<std::string, size_t> first_of_view;
  std::map<std::pair<std::string, std::string>, LightGroup> groups;
  for (size_t i = 0; i < photos.size(); ++i) {
    const NamedPhoto& name = names.photos[i];
    const size_t first = first_of_view.emplace(name.view, i).first->second;
    LightGroup& group = groups[{name.view, name.state}];
    group.view = static_cast<int>(first);
    group.photos.push_back(i);
    const bool is_alike = photos[i].pattern.rows() == photos[first].pattern.rows() &&
                          photos[i].pattern.cols() == photos[first].pattern.cols();
    group.is_absolute = group.is_absolute && is_alike && photos[i].RelativeExposure().has_value();
  }
  NamedGroups named;
  for (auto& [name, group] : groups) {
    const auto state = std::find_if(states.begin(), states.end(),
                                    [&, id = name.second](const GuessedState& one) { return one.id == id; });
    named.state.push_back(static_cast<int>(state - states.begin()));
    named.groups.push_back(std::move(group));
  }
  return named;
}

}  // namespace

std::vector<GuessedState> StatesByNamesAndLight(const PhotoNames& names,
                                                const std::vector<PhotoLook>& photos) {
  if (photos.size() != names.photos.size())
    throw std::invalid_argument("StatesByNamesAndLight: expected one photo a name, got " +
                                std::to_string(photos.size()) + " of " + std::to_string(names.photos.size()));
  const std::vector<GuessedState> states = GuessStates(names);
  const NamedGroups named = GroupsByName(names, photos, states);
  return WithMixesOfOccasions(states, photos, named.groups, named.state);
}

GroupedPhotos GroupPhotos(const std::vector<PhotoLook>& photos) {
  if (photos.empty()) throw std::invalid_argument("GroupPhotos: expected photos, got none");
  const std::vector<size_t> order = OrderOfCapture(photos);
  std::vector<PhotoLook> in_order;
  in_order.reserve(photos.size());
  for (const size_t i : order) in_order.push_back(photos[i]);
  GroupedPhotos sorted = GroupInOrder(in_order);
  NameByFolders(sorted, in_order);
  GroupedPhotos result = sorted;
  for (size_t k = 0; k < order.size(); ++k) {
    result.names.photos[order[k]] = sorted.names.photos[k];
    result.camera[order[k]] = sorted.camera[k];
  }
  return result;
}

}  // namespace luxfit
