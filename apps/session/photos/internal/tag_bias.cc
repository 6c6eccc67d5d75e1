#include "apps/session/photos/internal/tag_bias.h"

#include <algorithm>
#include <set>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

// Returns the mean of a tag's ln light over the groups of other views in the state of a group; empty where there are none.
std::optional<double> LightElsewhere(size_t group, int tag, const std::vector<LightGroup>& groups,
                                     const std::vector<int>& state) {
  double sum = 0;
  int count = 0;
  for (size_t j = 0; j < groups.size(); ++j) {
    if (state[j] != state[group] || groups[j].view == groups[group].view || !groups[j].is_absolute ||
        groups[j].camera != groups[group].camera)
      continue;
    const auto light = groups[j].log_light.find(tag);
    if (light == groups[j].log_light.end()) continue;
    sum += light->second;
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

double BiasOf(int view, int tag, const std::vector<LightGroup>& groups, const std::vector<int>& state) {
  constexpr size_t kFewestStates = 3;
  constexpr double kMostBias = 0.25;
  std::vector<double> differences;
  for (size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].view != view || !groups[i].is_absolute) continue;
    const auto light = groups[i].log_light.find(tag);
    if (light == groups[i].log_light.end()) continue;
    if (const auto elsewhere = LightElsewhere(i, tag, groups, state))
      differences.push_back(light->second - *elsewhere);
  }
  if (differences.size() < kFewestStates) return 0;
  const auto n = static_cast<double>(differences.size());
  return std::clamp(Median(differences) * n / (n + 1), -kMostBias, kMostBias);
}

}  // namespace

std::vector<LightGroup> WithoutTagBias(std::vector<LightGroup> groups, const std::vector<int>& state) {
  std::set<std::pair<int, int>> seen;  // view, tag
  for (const LightGroup& group : groups) {
    for (const auto& [tag, light] : group.log_light) seen.insert({group.view, tag});
  }
  for (const auto& [view, tag] : seen) {
    const double bias = BiasOf(view, tag, groups, state);
    for (LightGroup& group : groups) {
      const auto light = group.log_light.find(tag);
      if (group.view == view && light != group.log_light.end()) light->second -= bias;
    }
  }
  return groups;
}

}  // namespace luxfit
