#include "inverse/choose/internal/simplest_choice.h"

#include <algorithm>

namespace luxfit {

DetailChoice SimplestWithinOneStandardError(const std::vector<std::string>& names,
                                            const std::vector<std::map<int, GroupScore>>& scores) {
  constexpr double kWorthHaving = 0.1;
  DetailChoice choice;
  choice.among.reserve(names.size());
  size_t best = 0;
  for (size_t c = 0; c < names.size(); ++c) {
    choice.among.push_back({names[c], Mean(scores[c]), 0});
    if (choice.among[c].score < choice.among[best].score) best = c;
  }
  choice.chosen = static_cast<int>(best);
  for (size_t c = names.size(); c-- > 0;) {
    const PairedDifference worse = Difference(scores[c], scores[best]);
    choice.among[c].standard_error = worse.standard_error;
    if (c < best && worse.mean <= std::max(worse.standard_error, kWorthHaving * choice.among[best].score))
      choice.chosen = static_cast<int>(c);
  }
  return choice;
}

}  // namespace luxfit
