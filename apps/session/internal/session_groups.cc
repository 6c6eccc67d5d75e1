#include "apps/session/internal/session_groups.h"

#include <algorithm>

#include "apps/text/suggest.h"

namespace luxfit {
namespace {

bool HasId(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

SessionGroup ReadGroup(const TomlCursor::Member& member, const std::vector<std::string>& described) {
  if (member.value.IsText() && member.value.Text("\"estimate\"") == "estimate")
    return {member.name, {member.name}, true};
  SessionGroup group{member.name, {}, false};
  for (const TomlCursor& element :
       member.value.Elements("a list of luminaires such as [\"A\", \"B\"], or \"estimate\"")) {
    const std::string id = element.Text("the id of a luminaire");
    if (!described.empty() && !HasId(described, id)) {
      const std::string nearest = DidYouMean(id, described);
      throw element.Error("expected a luminaire of [[luminaire]] (" + ListNames(described) + "), got " +
                          Quoted(id) +
                          (nearest.empty() ? "; add [[luminaire]] with this id, or correct it" : nearest));
    }
    if (HasId(group.luminaires, id))
      throw element.Error("expected each luminaire once, got " + Quoted(id) + " twice; remove one of them");
    group.luminaires.push_back(id);
  }
  if (group.luminaires.empty())
    throw member.value.Error("expected one luminaire or more, got []; name them, or remove the group");
  return group;
}

}  // namespace

std::vector<SessionGroup> ReadGroups(const TomlCursor& session, const std::vector<std::string>& described) {
  const auto section = session.Find("groups");
  if (!section) return {};
  if (!session.Find("states"))
    throw section->Error(
        "expected [states] beside it, which name the groups, got none; add row1 = { row1 = 1.0 } and the "
        "like, or remove [groups]");
  std::vector<std::string> luminaires = described;
  std::vector<SessionGroup> groups;
  const std::vector<TomlCursor::Member> members = section->Members();
  for (const TomlCursor::Member& member : members) {
    groups.push_back(ReadGroup(member, described));
    if (groups.back().count_is_estimated) continue;
    for (const std::string& id : groups.back().luminaires) luminaires.push_back(id);
  }
  for (const TomlCursor::Member& member : members) {
    if (HasId(luminaires, member.name))
      throw member.value.Error("expected a name that no luminaire has, got " + Quoted(member.name) +
                               "; rename the group");
  }
  if (groups.empty())
    throw section->Error(
        "expected at least one group, got none; write row1 = [\"A\", \"B\"] or remove the section");
  return groups;
}

void ExpectGroupsAlone(const TomlCursor& session, const Session& read) {
  const auto section = session.Find("groups");
  if (!section) return;
  for (const TomlCursor::Member& member : section->Members()) {
    const bool is_counted = member.value.IsText();
    if (is_counted && StateOfGroupAlone(read, member.name) < 0)
      throw member.value.Error("expected a state in which " + member.name +
                               " alone is on, in which its luminaires can be counted, got none; add one to "
                               "[states], as in " +
                               member.name + " = { " + member.name +
                               " = 1.0 }, with photos, or name the luminaires");
  }
}

}  // namespace luxfit
