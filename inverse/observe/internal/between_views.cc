#include "inverse/observe/internal/between_views.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "inverse/observe/internal/pair_scatter.h"

namespace luxfit {
namespace {

constexpr size_t kLeastGroups = 30;
constexpr double kLeastEstimate = 1e-3;
constexpr size_t kMostViewPairs = 400'000;  // they tell s within 1 %

using ViewGroup = std::vector<Observation>;  // views of one element in one state

// Returns the groups that at least two different views show.
std::vector<ViewGroup> SharedGroups(const std::vector<Observation>& observations) {
  std::map<std::pair<int, int>, ViewGroup> by_element;  // and state
  for (const Observation& o : observations) {
    if (o.relative_luminance > 0 && std::isfinite(o.variance)) by_element[{o.element, o.state}].push_back(o);
  }
  std::vector<ViewGroup> shared;
  shared.reserve(by_element.size());
  for (auto& [key, group] : by_element) {
    const int first = group.front().view;
    if (std::any_of(group.begin(), group.end(), [&](const Observation& o) { return o.view != first; }))
      shared.push_back(std::move(group));
  }
  return shared;
}

void AddPairs(const ViewGroup& group, std::vector<ScatterPair>& pairs) {
  for (size_t a = 0; a < group.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      if (group[a].view == group[b].view) continue;  // two photos of one pose share its errors
      const double mean = 0.5 * (group[a].relative_luminance + group[b].relative_luminance);
      const double difference = (group[a].relative_luminance - group[b].relative_luminance) / mean;
      const double noise = (group[a].variance + group[b].variance) / (mean * mean);
      pairs.push_back({difference * difference, noise, 2.0 / static_cast<double>(group.size())});
    }
  }
}

// Returns the pairs of evenly taken groups, at most about kMostViewPairs.
std::vector<ScatterPair> PairsOf(const std::vector<ViewGroup>& groups) {
  size_t all = 0;
  for (const ViewGroup& group : groups) all += group.size() * (group.size() - 1) / 2;
  const size_t stride = 1 + all / kMostViewPairs;
  std::vector<ScatterPair> pairs;
  pairs.reserve(std::min(all, 2 * kMostViewPairs));
  for (size_t g = 0; g < groups.size(); g += stride) AddPairs(groups[g], pairs);
  return pairs;
}

}  // namespace

BetweenViews EstimateBetweenViews(const std::vector<Observation>& observations) {
  const std::vector<ViewGroup> groups = SharedGroups(observations);
  BetweenViews found;
  found.groups = static_cast<int>(groups.size());
  if (groups.size() < kLeastGroups) return found;
  found.relative_sigma = std::max(kLeastEstimate, ComponentOf(PairsOf(groups)));
  found.is_estimated = true;
  return found;
}

}  // namespace luxfit
