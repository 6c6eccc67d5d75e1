// Reads the lights over an object, for photometric stereo.
//
//   state,x,y,z[,strength]        the table of directions: towards the light, of any length but 0
//
// Throws std::runtime_error("FILE:LINE: key: ...") for a view or state that no photo has, a state of the
// object's view without a direction, and a view that is ambiguous.
//
// Source: docs/session-format.md, [lights].
#ifndef LUXFIT_APPS_SESSION_INTERNAL_SESSION_LIGHTS_H_
#define LUXFIT_APPS_SESSION_INTERNAL_SESSION_LIGHTS_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

// Returns the states that the photo table names, in its order. Each is a light of its own.
std::vector<SessionState> StatesOfLights(const CsvTable& photos);

SessionLights ReadLightsSection(const TomlCursor& section, const std::string& folder,
                                const std::vector<SessionPhoto>& photos);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_INTERNAL_SESSION_LIGHTS_H_
