// Writes what the linearize stage adds to a session as JSON, and reads it back.
//
// Reading throws nlohmann::json::exception where a key is missing or has another type.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_
#define LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/session/session.h"

namespace luxfit {

// Writes photos with their brackets, and cameras with response, vignetting and full scale.
nlohmann::json LinearizedJson(const Session& linearized);
// Completes the session, as it was read, by those.
Session WithLinearized(Session session, const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_
