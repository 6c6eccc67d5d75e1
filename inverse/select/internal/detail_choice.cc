#include "inverse/select/internal/detail_choice.h"

#include "inverse/select/one_standard_error.h"

namespace luxfit {

DetailChoice ChooseDetail(const std::vector<std::string>& names, const std::vector<GroupScores>& scores) {
  std::vector<SelectionCandidate> candidates;
  candidates.reserve(scores.size());
  for (const GroupScores& score : scores)
    candidates.push_back({score, static_cast<double>(candidates.size()), true});
  SelectionOptions options;
  options.worth_having = 0.1;
  const Selection selection = SimplestWithinOneStandardError(candidates, options);
  DetailChoice choice;
  for (size_t c = 0; c < names.size(); ++c)
    choice.among.push_back({names[c], selection.score[c], selection.standard_error[c]});
  choice.chosen = static_cast<int>(selection.chosen);
  return choice;
}

}  // namespace luxfit
