// Reads [groups]: luminaires that are switched together, under one name.
//
// A state may name a group in place of its luminaires. Groups may share luminaires.
//
// Throws std::runtime_error("FILE:LINE: key: ...") for [groups] without [states], empty groups, names that are
// luminaires, ids that [[luminaire]] does not have, and ids that a group names twice.
//
// row1 = "estimate": the number of its luminaires is not known. Until they are counted, one luminaire of the group's
// name stands for them.
//
// Source: docs/session-format.md, [groups].
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_GROUPS_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_GROUPS_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

// Returns the groups in file order; none without the section. `session` is the whole document, `described` the
// ids of [[luminaire]]: where there are any, groups name these alone. Otherwise groups name the luminaires.
std::vector<SessionGroup> ReadGroups(const TomlCursor& session, const std::vector<std::string>& described);

// Throws std::runtime_error where a group whose number is to be estimated is on alone in no state.
void ExpectGroupsAlone(const TomlCursor& session, const Session& read);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_GROUPS_H_
