#include "inverse/observe/camera/internal/radiometry/camera_ties.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "inverse/observe/camera/internal/radiometry/photo_equations.h"

namespace luxfit {
namespace {

constexpr size_t kLeastPatches = 5;

using CameraPair = std::pair<int, int>;  // the smaller first

std::map<CameraPair, std::set<int>> PatchesInCommon(const Patches& patches,
                                                    const std::vector<PhotoSample>& samples) {
  std::map<std::pair<int, int>, std::set<int>> cameras_of;  // by element and state
  for (const PhotoSample& s : samples) cameras_of[{s.element, s.state}].insert(s.camera);
  std::map<CameraPair, std::set<int>> common;
  for (const auto& [seen, cameras] : cameras_of) {
    const int patch = patches.elements[static_cast<size_t>(seen.first)].patch;
    for (auto a = cameras.begin(); a != cameras.end(); ++a) {
      for (auto b = std::next(a); b != cameras.end(); ++b) common[{*a, *b}].insert(patch);
    }
  }
  return common;
}

bool AreEnough(const std::set<int>& patches) {
  std::set<int> folds;
  for (const int patch : patches) folds.insert(patch % PhotoEquations::kFolds);
  return patches.size() >= kLeastPatches && folds.size() > 1;
}

// Returns the number of each camera's group, which is the lowest camera in it.
std::vector<int> GroupsOf(size_t cameras, const std::map<CameraPair, std::set<int>>& common) {
  std::vector<int> group(cameras);
  for (size_t c = 0; c < cameras; ++c) group[c] = static_cast<int>(c);
  for (const auto& [pair, patches] : common) {
    if (!AreEnough(patches)) continue;
    const int a = group[static_cast<size_t>(pair.first)], b = group[static_cast<size_t>(pair.second)];
    std::replace(group.begin(), group.end(), std::max(a, b), std::min(a, b));
  }
  return group;
}

template <typename Condition>
std::vector<PhotoSample> Selected(const std::vector<PhotoSample>& samples, const Condition& condition) {
  std::vector<PhotoSample> selected;
  selected.reserve(samples.size());
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(selected), condition);
  return selected;
}

}  // namespace

CameraTies TieCameras(const Patches& patches, const std::vector<PhotoSample>& samples,
                      const std::vector<bool>& gain_is_stated) {
  const size_t cameras = gain_is_stated.size();
  const std::vector<int> group = GroupsOf(cameras, PatchesInCommon(patches, samples));
  std::set<int> seen;
  for (const PhotoSample& s : samples) seen.insert(s.camera);
  CameraTies ties;
  ties.reference = group;
  std::set<int> tied_groups;
  for (size_t c = cameras; c-- > 0;) {
    if (!gain_is_stated[c]) continue;
    tied_groups.insert(group[c]);
    // The first stated camera of a group is the last one here.
    for (size_t d = 0; d < cameras; ++d) {
      if (group[d] == group[c]) ties.reference[d] = static_cast<int>(c);
    }
  }
  if (tied_groups.empty() && !seen.empty()) tied_groups.insert(group[static_cast<size_t>(*seen.begin())]);
  ties.is_tied.resize(cameras);
  for (size_t c = 0; c < cameras; ++c)
    ties.is_tied[c] = seen.count(static_cast<int>(c)) == 0 || tied_groups.count(group[c]) > 0;
  return ties;
}

std::vector<PhotoSample> SamplesWithinGroups(const std::vector<PhotoSample>& samples,
                                             const std::vector<int>& reference) {
  std::map<int, std::set<int>> groups_of;  // by element
  for (const PhotoSample& s : samples) groups_of[s.element].insert(reference[static_cast<size_t>(s.camera)]);
  return Selected(samples, [&](const PhotoSample& s) { return groups_of[s.element].size() == 1; });
}

std::vector<PhotoSample> SamplesSeenBySeveral(const std::vector<PhotoSample>& samples) {
  std::map<int, std::set<int>> cameras_of;  // by element
  for (const PhotoSample& s : samples) cameras_of[s.element].insert(s.camera);
  return Selected(samples, [&](const PhotoSample& s) { return cameras_of[s.element].size() > 1; });
}

}  // namespace luxfit
