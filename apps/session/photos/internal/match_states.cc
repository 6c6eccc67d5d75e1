#include "apps/session/photos/internal/match_states.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "apps/session/photos/internal/least_cost.h"
#include "apps/session/photos/internal/tag_bias.h"

namespace luxfit {
namespace {

constexpr double kMostCost = 10;
constexpr double kAlike =
    0.3;  // in ln light: prints reflect, lenses shade and clocks of shutters err by less

constexpr double kShare = 0.02;  // brightness of whole pictures decides where tags do not

using Labels = std::vector<int>;  // of groups; -1: none yet

// Numbers the states in the order of their first groups.
void Renumber(Labels& labels) {
  std::map<int, int> number;
  for (int& label : labels) {
    if (label >= 0) label = number.emplace(label, static_cast<int>(number.size())).first->second;
  }
}

struct Differences {
  std::vector<std::vector<std::optional<double>>> tags;  // empty inside a view
  std::vector<double> share;                             // level less the greatest level of the view
};

Differences DifferencesOf(const std::vector<LightGroup>& groups) {
  Differences differences;
  differences.tags.assign(groups.size(), std::vector<std::optional<double>>(groups.size()));
  std::map<int, double> greatest;
  for (size_t i = 0; i < groups.size(); ++i) {
    const auto at = greatest.emplace(groups[i].view, groups[i].level).first;
    at->second = std::max(at->second, groups[i].level);
    for (size_t j = 0; j < groups.size(); ++j) {
      if (groups[i].view != groups[j].view) differences.tags[i][j] = TagLightDifference(groups[i], groups[j]);
    }
  }
  for (const LightGroup& group : groups) differences.share.push_back(group.level - greatest.at(group.view));
  return differences;
}

// How well a group fits a state: the mean difference to its groups.
struct Fit {
  int state = -1;
  bool is_by_tags = false;
  double difference = 0;  // by tags, or else `share`
  double share = 0;       // of the shares of their views' greatest brightness
};

Fit FitOf(size_t group, int state, const Labels& labels, const Differences& differences) {
  double tags = 0, share = 0;
  int tag_count = 0, count = 0;
  for (size_t j = 0; j < labels.size(); ++j) {
    if (labels[j] != state || j == group) continue;
    share += std::abs(differences.share[group] - differences.share[j]);
    ++count;
    if (!differences.tags[group][j]) continue;
    tags += *differences.tags[group][j];
    ++tag_count;
  }
  const double mean_share = count > 0 ? share / count : std::numeric_limits<double>::infinity();
  if (tag_count > 0) return {state, true, tags / tag_count, mean_share};
  return {state, false, mean_share, mean_share};
}

double CostOf(const Fit& fit) {
  return std::min(kMostCost, (fit.is_by_tags ? fit.difference : kAlike) + kShare * fit.share);
}

std::map<int, std::vector<size_t>> GroupsByView(const std::vector<LightGroup>& groups) {
  std::map<int, std::vector<size_t>> by_view;
  for (size_t i = 0; i < groups.size(); ++i) by_view[groups[i].view].push_back(i);
  return by_view;
}

double Disagreement(const std::vector<LightGroup>& groups, const Labels& labels,
                    const Differences& differences) {
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < groups.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const auto& d = differences.tags[i][j];
      if (!d) continue;
      const double share = kShare * std::abs(differences.share[i] - differences.share[j]);
      sum += labels[i] == labels[j] ? std::min(*d, 1.0) + share : std::max(0.0, kAlike - *d);
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

// Gives the groups of a view the states of least difference together, or new ones where none is alike.
void LabelView(const std::vector<size_t>& of_view, const Differences& differences, Labels& labels) {
  constexpr double kNewState = 1.2 * kAlike;
  for (const size_t i : of_view) labels[i] = -1;
  const int states = *std::max_element(labels.begin(), labels.end()) + 1;
  const auto rows = static_cast<Eigen::Index>(of_view.size());
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(rows, states + rows, kNewState);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const size_t group = of_view[static_cast<size_t>(k)];
    for (int state = 0; state < states; ++state) {
      cost(k, state) = CostOf(FitOf(group, state, labels, differences));
    }
  }
  const std::vector<int> columns = LeastCostColumns(cost);
  for (size_t k = 0; k < of_view.size(); ++k) labels[of_view[k]] = columns[k];
  Renumber(labels);
}

// Counts, for every group, the groups of a view that share tags with it.
void AddEvidence(const std::vector<size_t>& of_view, const Differences& differences,
                 std::vector<int>& evidence) {
  for (size_t i = 0; i < evidence.size(); ++i) {
    for (const size_t j : of_view) evidence[i] += differences.tags[i][j] ? 1 : 0;
  }
}

// Starts at a view, and goes on with the view of most evidence. Then each view is looked at again with the evidence of all
// others.
Labels ByLightFrom(int first_view, const std::vector<LightGroup>& groups, const Differences& differences) {
  constexpr int kRounds = 3;
  Labels labels(groups.size(), -1);
  std::vector<int> evidence(groups.size(), 0);
  auto to_do = GroupsByView(groups);
  const std::vector<size_t> first = to_do.at(first_view);
  for (size_t k = 0; k < first.size(); ++k) labels[first[k]] = static_cast<int>(k);
  AddEvidence(first, differences, evidence);
  to_do.erase(first_view);
  const auto evidence_of = [&](const std::vector<size_t>& of_view) {
    return std::accumulate(of_view.begin(), of_view.end(), 0,
                           [&](int sum, size_t i) { return sum + evidence[i]; });
  };
  std::vector<std::vector<size_t>> done;
  while (!to_do.empty()) {
    const auto next = std::max_element(to_do.begin(), to_do.end(), [&](const auto& a, const auto& b) {
      return evidence_of(a.second) < evidence_of(b.second);
    });
    LabelView(next->second, differences, labels);
    AddEvidence(next->second, differences, evidence);
    done.push_back(next->second);
    to_do.erase(next);
  }
  for (int round = 0; round < kRounds; ++round) {
    for (const std::vector<size_t>& of_view : done) LabelView(of_view, differences, labels);
  }
  return labels;
}

// Starts at each of the views with the most states, and takes what disagrees least.
Labels ByLight(const std::vector<LightGroup>& groups, const Differences& differences) {
  constexpr size_t kStarts = 12;
  std::vector<std::pair<size_t, int>> views;
  for (const auto& [view, of_view] : GroupsByView(groups)) views.emplace_back(of_view.size(), view);
  std::stable_sort(views.begin(), views.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  views.resize(std::min(kStarts, views.size()));
  Labels best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [size, view] : views) {
    const Labels labels = ByLightFrom(view, groups, differences);
    const double disagreement = Disagreement(groups, labels, differences);
    if (disagreement >= least) continue;
    least = disagreement;
    best = labels;
  }
  return best;
}

// Returns the increasing states of least cost for the groups of a view.
std::vector<int> InOrder(const std::vector<size_t>& of_view, int states, const Labels& labels,
                         const Differences& differences) {
  // least[k][s]: cost of the first k groups in the first s states.
  const size_t columns = static_cast<size_t>(states) + 1;
  std::vector<std::vector<double>> least(
      of_view.size() + 1, std::vector<double>(columns, std::numeric_limits<double>::infinity()));
  least[0].assign(columns, 0);
  for (size_t k = 1; k <= of_view.size(); ++k) {
    for (size_t s = 1; s < columns; ++s) {
      const Fit fit = FitOf(of_view[k - 1], static_cast<int>(s) - 1, labels, differences);
      least[k][s] = std::min(least[k][s - 1], least[k - 1][s - 1] + CostOf(fit));
    }
  }
  std::vector<int> result(of_view.size());
  size_t s = columns - 1;
  for (size_t k = of_view.size(); k > 0; --k, --s) {
    while (least[k][s] == least[k][s - 1]) --s;
    result[k - 1] = static_cast<int>(s) - 1;
  }
  return result;
}

// Numbers the groups of the views with the most states. Groups of other views keep that order, and skip the states that
// they fit least.
Labels ByOrder(const std::vector<LightGroup>& groups, const Differences& differences) {
  const auto by_view = GroupsByView(groups);
  size_t most = 0;
  for (const auto& [view, of_view] : by_view) most = std::max(most, of_view.size());
  Labels labels(groups.size(), -1);
  for (const auto& [view, of_view] : by_view) {
    for (size_t k = 0; k < of_view.size() && of_view.size() == most; ++k)
      labels[of_view[k]] = static_cast<int>(k);
  }
  const Labels of_full_views = labels;
  for (const auto& [view, of_view] : by_view) {
    if (of_view.size() == most) continue;
    const std::vector<int> states = InOrder(of_view, static_cast<int>(most), of_full_views, differences);
    for (size_t k = 0; k < of_view.size(); ++k) labels[of_view[k]] = states[k];
  }
  return labels;
}

// A new state begins where a view comes a second time. Says nothing where that makes more states than a view shows.
Labels ByWalk(const std::vector<LightGroup>& groups) {
  Labels labels;
  std::set<int> seen;
  int state = 0;
  for (const LightGroup& group : groups) {
    if (!seen.insert(group.view).second) {
      seen = {group.view};
      ++state;
    }
    labels.push_back(state);
  }
  for (const auto& [view, of_view] : GroupsByView(groups)) {
    if (static_cast<int>(of_view.size()) == state + 1) return labels;
  }
  return {};
}

// Returns what it would cost to give a group another state, and its own to the group of its view that has that one.
double CostOfSwap(size_t group, int other, const std::vector<LightGroup>& groups, const Labels& labels,
                  const Differences& differences) {
  const auto cost = [&](size_t i, int state) { return CostOf(FitOf(i, state, labels, differences)); };
  double more = cost(group, other) - cost(group, labels[group]);
  for (size_t j = 0; j < groups.size(); ++j) {
    if (groups[j].view == groups[group].view && labels[j] == other)
      more += cost(j, labels[group]) - cost(j, other);
  }
  return more;
}

std::string DoubtAbout(size_t group, const std::vector<LightGroup>& groups, const Labels& labels,
                       const Differences& differences) {
  constexpr double kClear = 0.1;
  const int state = labels[group];
  const Fit own = FitOf(group, state, labels, differences);
  if (!std::isfinite(own.difference)) return "no other view shows its state";
  if (!own.is_by_tags) return "it shows no tags that another view shows in this state";
  if (own.difference > kAlike) return "its tags are lit otherwise than in other views of this state";
  const int states = *std::max_element(labels.begin(), labels.end()) + 1;
  for (int other = 0; other < states; ++other) {
    if (other != state && CostOfSwap(group, other, groups, labels, differences) < kClear)
      return "its tags are lit much as in two states";
  }
  return "";
}

}  // namespace

MatchedStates MatchStates(const std::vector<LightGroup>& groups) {
  const Differences differences = DifferencesOf(groups);
  const Labels by_light = ByLight(groups, differences);
  const std::vector<std::pair<std::string, Labels>> explanations = {
      {"all views were photographed in one state before the next", ByWalk(groups)},
      {"every view was photographed in the same order of states", ByOrder(groups, differences)},
      {"tags are lit alike in photos of one state", by_light},
      {"tags are lit alike in photos of one state",
       ByLight(groups, DifferencesOf(WithoutTagBias(groups, by_light)))}};
  MatchedStates best;
  Differences of_best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [because, labels] : explanations) {
    if (labels.empty()) continue;
    // Each explanation is judged without the biases that it implies.
    const Differences rest = DifferencesOf(WithoutTagBias(groups, labels));
    const double disagreement = Disagreement(groups, labels, rest);
    if (disagreement >= least) continue;
    least = disagreement;
    best.state = labels;
    best.because = because;
    of_best = rest;
  }
  Renumber(best.state);
  for (size_t i = 0; i < groups.size(); ++i) best.doubt.push_back(DoubtAbout(i, groups, best.state, of_best));
  return best;
}

}  // namespace luxfit
