#include "inverse/observe/as_if/states_as_if.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "inverse/observe/as_if/internal/superposed_columns.h"
#include "inverse/observe/as_if/internal/table_mistake.h"
#include "inverse/select/contradicted.h"

namespace luxfit {
namespace {

constexpr int kSuperposedElements = 500;
constexpr Eigen::Index kFewestColumns = 30;
constexpr double kExplainsStates = 3;  // highest score of an explanation
// As the readings' mean error from which a result is in doubt (inverse/check/luxmeter_check.h). Dimmers that are a tenth off,
// and are left alone, stay below it.
constexpr double kFarOff = 0.05;

void ExpectWhole(const StateTable& table, const std::vector<Observation>& observations) {
  const auto luminaires = static_cast<Eigen::Index>(table.luminaires.size());
  bool is_whole = table.states.size() == table.dimming.size();
  for (const Eigen::VectorXd& row : table.dimming) is_whole = is_whole && row.size() == luminaires;
  for (const Observation& o : observations)
    is_whole = is_whole && o.state >= 0 && o.state < static_cast<int>(table.states.size());
  if (!is_whole)
    throw std::invalid_argument("FindStatesAsIf: expected one dimming value for each state and luminaire");
}

Eigen::MatrixXd DimmingOfRows(const StateTable& table, const SuperposedColumns& columns) {
  Eigen::MatrixXd dimming(static_cast<Eigen::Index>(columns.states.size()),
                          static_cast<Eigen::Index>(table.luminaires.size()));
  for (Eigen::Index i = 0; i < dimming.rows(); ++i)
    dimming.row(i) = table.dimming[static_cast<size_t>(columns.states[static_cast<size_t>(i)])].transpose();
  return dimming;
}

struct JudgedMistake {
  TableMistake mistake;
  SuperpositionScore score;
};

std::vector<JudgedMistake> Holding(std::vector<TableMistake> mistakes, const SuperposedColumns& columns,
                                   const GroupScores& as_given, int rank) {
  std::vector<JudgedMistake> holding;
  for (TableMistake& mistake : mistakes) {
    if (RankOf(mistake.dimming) > rank) continue;  // it would explain more for being freer
    SuperpositionScore score = ScoreOf(columns, mistake.dimming);
    if (Mean(score.scores) <= kExplainsStates && IsContradicted(as_given, score.scores))
      holding.push_back({std::move(mistake), std::move(score)});
  }
  std::stable_sort(holding.begin(), holding.end(), [](const JudgedMistake& a, const JudgedMistake& b) {
    return Mean(a.score.scores) < Mean(b.score.scores);
  });
  const auto is_refused = [&](const JudgedMistake& m) {
    return Mean(m.score.scores) > 1 && IsContradicted(m.score.scores, holding.front().score.scores);
  };
  holding.erase(std::remove_if(holding.begin(), holding.end(), is_refused), holding.end());
  return holding;
}

// Holds what the photos say of the table as given.
struct JudgedTable {
  SuperposedColumns columns;
  Eigen::MatrixXd dimming;  // of the columns' rows
  int rank = 0;
  SuperpositionScore score;
};

// Returns nothing where the photos tell nothing of it.
std::optional<JudgedTable> Judge(const Patches& patches, const std::vector<Observation>& observations,
                                 const StateTable& table) {
  ExpectWhole(table, observations);
  JudgedTable judged;
  judged.columns = ColumnsOf(patches, ThinElements(observations, kSuperposedElements));
  if (judged.columns.luminance.cols() < kFewestColumns) return {};
  judged.dimming = DimmingOfRows(table, judged.columns);
  judged.rank = RankOf(judged.dimming);
  if (judged.rank >= judged.dimming.rows()) return {};
  judged.score = ScoreOf(judged.columns, judged.dimming);
  return judged;
}

// Returns whether the table as given explains decoded photos, and better than a mistake explains them as given.
bool IsCurve(const Patches& patches, const std::vector<Observation>& decoded, const StateTable& table,
             const JudgedMistake& best) {
  if (decoded.empty()) return false;
  const std::optional<JudgedTable> judged = Judge(patches, decoded, table);
  if (!judged) return false;
  const double score = Mean(judged->score.scores);
  return score <= kExplainsStates && score < Mean(best.score.scores);
}

}  // namespace

std::vector<StateExplanation> FindStatesAsIf(const Patches& patches,
                                             const std::vector<Observation>& observations,
                                             const StateTable& table,
                                             const std::vector<Observation>& decoded) {
  const std::optional<JudgedTable> judged = Judge(patches, observations, table);
  if (!judged || Mean(judged->score.scores) <= 1) return {};
  const SuperposedColumns& columns = judged->columns;
  const SuperpositionScore& as_given = judged->score;
  const std::vector<JudgedMistake> holding =
      Holding(TableMistakes(table, columns, judged->dimming), columns, as_given.scores, judged->rank);
  if (std::all_of(holding.begin(), holding.end(),
                  [](const JudgedMistake& m) { return m.mistake.is_of_whole_state; }) ||
      IsCurve(patches, decoded, table, holding.front()))
    return {};
  std::vector<StateExplanation> explanations;
  for (const JudgedMistake& m : holding) {
    StateExplanation e{m.mistake.as_if, m.mistake.remedy, table.dimming, as_given.relative_difference,
                       m.score.relative_difference};
    for (Eigen::Index i = 0; i < m.mistake.dimming.rows(); ++i)
      e.dimming[static_cast<size_t>(columns.states[static_cast<size_t>(i)])] =
          m.mistake.dimming.row(i).transpose();
    explanations.push_back(std::move(e));
  }
  return explanations;
}

std::optional<StateExplanation> StatesByThemselves(const Patches& patches,
                                                   const std::vector<Observation>& corrected,
                                                   const StateTable& table) {
  const std::optional<JudgedTable> judged = Judge(patches, corrected, table);
  if (!judged || Mean(judged->score.scores) <= kExplainsStates ||
      judged->score.relative_difference <= kFarOff)
    return {};
  StateExplanation explanation;
  explanation.as_if = "a luminaire gave another light in one state than in the others";
  explanation.remedy =
      "look whether one of several on a switch was off or still warming up, and photograph the states again "
      "with all lamps warm";
  const auto states = static_cast<Eigen::Index>(table.states.size());
  for (Eigen::Index s = 0; s < states; ++s)
    explanation.dimming.emplace_back(Eigen::VectorXd::Unit(states, s));
  explanation.difference_as_given = judged->score.relative_difference;
  return explanation;
}

std::string InWords(const std::vector<StateExplanation>& explanations) {
  std::string text = "the photos look as if ";
  for (size_t i = 0; i < explanations.size(); ++i)
    text += (i > 0 ? ", or as if " : "") + explanations[i].as_if;
  if (explanations.size() > 1) text += ", which explain them equally";
  if (!explanations.front().IsOfTable())
    return text + fmt::format(
                      ": they differ by {:.0f} % from what states add up to, and no value of the table "
                      "explains that",
                      100 * explanations.front().difference_as_given);
  return text + fmt::format(
                    ": so read, they differ by {:.1f} % from what states add up to, and by {:.0f} % "
                    "as given",
                    100 * explanations.front().difference, 100 * explanations.front().difference_as_given);
}

}  // namespace luxfit
