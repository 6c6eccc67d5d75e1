#include "inverse/select/group_scores.h"

#include <cmath>
#include <limits>

namespace luxfit {

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

}  // namespace luxfit
