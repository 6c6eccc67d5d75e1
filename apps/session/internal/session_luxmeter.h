// Reads the luxmeter of a session: its readings, the role of each, and its class.
//
//   id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx   empty illuminance_lx: not measured, to be predicted only
//
// `lux` is an alias of the column illuminance_lx.
//
//   angle_deg,relative                     the sensitivity curve: from 0, ascending, >= 0
//
// A pattern is id or id@state, in which * stands for any text. A reading that a pattern of `fit` matches is
// fitted, one that a pattern of `scale` matches fixes the absolute scale, and every other one only checks.
// The class (DIN 5032-7: L 3 %, A 5 %, B 10 %, C 20 %) is the total error with k = 2. Half of it is the
// standard uncertainty that all readings share.
//
// Throws std::runtime_error("FILE:LINE: key: ...") for a pattern that matches nothing, a reading with two
// roles, a role for a reading that was not measured, readings given twice, a normal of zero length, an
// illuminance < 0 and a sensitivity curve that does not ascend from 0.
//
// Source: docs/session-format.md, [luxmeter]; DIN 5032-7; CIE S 023.
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_LUXMETER_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_LUXMETER_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

CsvTable ReadReadingTable(const TomlCursor& section, const std::string& folder);

// Reads a table of readings without a session, which may name any states.
std::vector<SessionReading> ReadReadingsAlone(const std::string& path);

SessionLuxmeter LuxmeterOf(const TomlCursor& section, const std::string& folder, const CsvTable& table,
                           const std::vector<SessionState>& states);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_LUXMETER_H_
