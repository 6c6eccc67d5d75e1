// What the linearize stage adds to a session, as JSON and back.
//
// Reading throws nlohmann::json::exception where a key is missing or of another kind.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_
#define LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/session/session.h"

namespace luxfit {

// Photos with their brackets, cameras with response, vignetting and full scale.
nlohmann::json LinearizedJson(const Session& linearized);
// The session as read, completed by that.
Session WithLinearized(Session session, const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_
