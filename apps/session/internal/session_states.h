// Resolves the states that tables name.
//
// Source: docs/session-format.md, [states].
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_STATES_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_STATES_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/csv_table.h"

namespace luxfit {

// Returns the column `state` of a row. Throws std::runtime_error with the known states and the nearest one
// where it is unknown.
std::string StateOfRow(const CsvTable& table, const CsvRow& row, const std::vector<SessionState>& states);

// Returns the one state of a session without [states], with every luminaire fully on. All rows must name it;
// it is "all" where there is no row. Throws std::runtime_error at the first row that names another.
SessionState OnlyState(const std::vector<CsvTable>& tables, const std::vector<SessionLuminaire>& luminaires);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_STATES_H_
