#include "apps/session/internal/session_states.h"

#include <algorithm>
#include <optional>

#include "apps/text/suggest.h"

namespace luxfit {

std::string StateOfRow(const CsvTable& table, const CsvRow& row, const std::vector<SessionState>& states) {
  const std::string& id = CsvText(table, row, "state");
  std::vector<std::string> known;
  known.reserve(states.size());
  for (const SessionState& state : states) known.push_back(state.id);
  if (std::find(known.begin(), known.end(), id) != known.end()) return id;
  const std::string nearest = DidYouMean(id, known);
  throw CsvError(table, row, "state",
                 "expected a known state (" + ListNames(known) + "), got " + Quoted(id) +
                     (nearest.empty() ? "; add it to [states], or correct the row" : nearest));
}

SessionState OnlyState(const std::vector<CsvTable>& tables, const std::vector<SessionLuminaire>& luminaires) {
  SessionState only{"all", {}};
  for (const SessionLuminaire& luminaire : luminaires) only.dimming[luminaire.id] = 1;
  std::optional<std::string> first_place;
  for (const CsvTable& table : tables) {
    for (const CsvRow& row : table.rows) {
      const std::string& id = CsvText(table, row, "state");
      if (id.empty())
        throw CsvError(table, row, "state", "expected a name, got nothing; name what is switched on");
      if (!first_place) {
        only.id = id;
        first_place = table.path + ":" + std::to_string(row.line);
      } else if (id != only.id) {
        throw CsvError(table, row, "state",
                       "expected " + Quoted(only.id) + " as in " + *first_place + ", got " + Quoted(id) +
                           "; name both in [states] with what is on in each");
      }
    }
  }
  return only;
}

}  // namespace luxfit
