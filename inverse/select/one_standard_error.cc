#include "inverse/select/one_standard_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace luxfit {
namespace {

std::size_t BestOf(const std::vector<SelectionCandidate>& candidates, const std::vector<double>& score) {
  std::size_t best = candidates.size();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!candidates[c].is_eligible) continue;
    if (best == candidates.size() || score[c] < score[best]) best = c;
  }
  if (best == candidates.size())
    throw std::invalid_argument("SimplestWithinOneStandardError: expected an eligible candidate");
  return best;
}

}  // namespace

double Mean(const GroupScores& scores) {
  GroupScore all;
  for (const auto& [group, score] : scores) all = {all.sum + score.sum, all.count + score.count};
  return all.sum / all.count;
}

PairedDifference Difference(const GroupScores& a, const GroupScores& b) {
  double total = 0;
  PairedDifference result;
  for (const auto& [group, score] : a) {
    total += score.count;
    result.mean += score.sum - b.at(group).sum;
  }
  result.mean /= total;
  double squares = 0;
  for (const auto& [group, score] : a)
    squares += std::pow(score.sum - b.at(group).sum - score.count * result.mean, 2);
  const double groups = static_cast<double>(a.size());
  const double freedom = groups - 1;
  result.standard_error = freedom > 2
                              ? std::sqrt(squares * groups / freedom * freedom / (freedom - 2)) / total
                              : std::numeric_limits<double>::infinity();
  return result;
}

Selection SimplestWithinOneStandardError(const std::vector<SelectionCandidate>& candidates,
                                         const SelectionOptions& options) {
  Selection selection;
  for (const SelectionCandidate& c : candidates) selection.score.push_back(Mean(c.scores));
  selection.best = selection.chosen = BestOf(candidates, selection.score);
  const double best_score = selection.score[selection.best];
  bool keeps_first = false;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const PairedDifference worse = Difference(candidates[c].scores, candidates[selection.best].scores);
    selection.standard_error.push_back(worse.standard_error);
    const double margin =
        std::max(options.standard_errors * worse.standard_error, options.worth_having * best_score);
    if (!candidates[c].is_eligible || !(worse.mean <= margin)) continue;
    keeps_first = keeps_first || (c == 0 && options.keeps_first);
    const double simplest = candidates[selection.chosen].complexity;
    const bool is_better = selection.score[c] < selection.score[selection.chosen];
    if (candidates[c].complexity < simplest || (candidates[c].complexity == simplest && is_better))
      selection.chosen = c;
  }
  if (keeps_first) selection.chosen = 0;
  return selection;
}

}  // namespace luxfit
