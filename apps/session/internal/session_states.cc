#include "apps/session/internal/session_states.h"

#include <algorithm>
#include <map>
#include <optional>

#include "apps/text/suggest.h"

namespace luxfit {
namespace {

const SessionGroup* FindGroup(const std::vector<SessionGroup>& groups, const std::string& name) {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [&](const SessionGroup& one) { return one.name == name; });
  return found == groups.end() ? nullptr : &*found;
}

double ReadDimming(const TomlCursor& value) {
  const double dimming = value.Number("a dimming in 0..1");
  if (dimming < 0 || dimming > 1)
    throw value.Error("expected a dimming in 0..1, got " + value.Shown() + "; 30 % is written 0.3");
  return dimming;
}

// Reads one state. Its groups and luminaires may overlap where they say the same.
SessionState ReadState(const TomlCursor::Member& member, const std::vector<SessionGroup>& groups) {
  SessionState state{member.name, {}};
  std::map<std::string, std::string> said_by;  // luminaire -> group or luminaire, as the file has it
  for (const auto& [name, value] : member.value.Members()) {
    const double dimming = ReadDimming(value);
    const SessionGroup* const group = FindGroup(groups, name);
    for (const std::string& id : group ? group->luminaires : std::vector<std::string>{name}) {
      if (state.dimming.emplace(id, dimming).second) {
        said_by[id] = name;
      } else if (state.dimming[id] != dimming) {
        throw value.Error("expected one dimming of " + Quoted(id) + ", got " + value.Shown() +
                          " beside that of " + Quoted(said_by[id]) +
                          "; give both the same, or name the luminaires one by one");
      }
    }
  }
  return state;
}

}  // namespace

std::vector<SessionState> ReadStates(const TomlCursor& section, const std::vector<SessionGroup>& groups) {
  std::vector<SessionState> states;
  for (const TomlCursor::Member& member : section.Members()) states.push_back(ReadState(member, groups));
  if (states.empty())
    throw section.Error("expected at least one state, got none; write A = { A = 1.0 } or remove the section");
  return states;
}

std::vector<std::string> LuminairesOfStates(const TomlCursor& section,
                                            const std::vector<SessionGroup>& groups,
                                            const std::vector<std::string>& known) {
  std::vector<std::string> names = known;
  for (const SessionGroup& group : groups) names.push_back(group.name);
  std::vector<std::string> ids;
  std::map<std::string, std::string> spelling;  // by the name in small letters
  for (const std::string& name : names) spelling.emplace(Lowercase(name), name);
  for (const TomlCursor::Member& state : section.Members()) {
    for (const auto& [name, value] : state.value.Members()) {
      const std::string& other = spelling.emplace(Lowercase(name), name).first->second;
      if (other != name)
        throw value.Error("expected luminaires whose names differ by more than capitals, got " +
                          Quoted(name) + " beside " + Quoted(other) +
                          "; write both alike, or give one another name");
      if (FindGroup(groups, name) != nullptr) continue;
      if (!groups.empty() && std::find(known.begin(), known.end(), name) == known.end()) {
        const std::string nearest = DidYouMean(name, names);
        throw value.Error("expected a group or a luminaire that [[luminaire]] or [groups] names (" +
                          ListNames(names) + "), got " + Quoted(name) +
                          (nearest.empty() ? "; add it to one of them, or correct it" : nearest));
      }
      ids.push_back(name);
    }
  }
  return ids;
}

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
