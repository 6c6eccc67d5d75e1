// Reads [states], and resolves the states that tables name.
//
// Throws std::runtime_error("FILE:LINE: key: ...") for dimmings outside 0..1, names that are neither a group nor a
// luminaire where there are groups, and dimmings of one luminaire that differ within a state.
//
// Source: docs/session-format.md, [states].
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_STATES_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_STATES_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

// Reads the states in file order, with the dimming of each luminaire that they or their groups name.
std::vector<SessionState> ReadStates(const TomlCursor& section, const std::vector<SessionGroup>& groups);

// Returns the luminaires that the states name themselves, in the order of the file. `known`: the luminaires that the
// file names elsewhere. With groups, the states must name these or groups.
std::vector<std::string> LuminairesOfStates(const TomlCursor& section,
                                            const std::vector<SessionGroup>& groups,
                                            const std::vector<std::string>& known);

// Returns the column `state` of a row. Throws std::runtime_error with the known states and the nearest one
// where it is unknown.
std::string StateOfRow(const CsvTable& table, const CsvRow& row, const std::vector<SessionState>& states);

// Returns the one state of a session without [states], with every luminaire fully on. All rows must name it;
// it is "all" where there is no row. Throws std::runtime_error at the first row that names another.
SessionState OnlyState(const std::vector<CsvTable>& tables, const std::vector<SessionLuminaire>& luminaires);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_STATES_H_
