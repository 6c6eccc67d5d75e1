// Cameras and poses as JSON and back: what OUT/stages/register.json holds beside its provenance.
//
// Nothing is lost on the way but what only the making of it needs (`notes` come back as they went in). A
// camera is {"id", "width_px", ..., "distortion", "lens", "spline"}, a pose `cam_from_world` the twelve
// numbers of a 3 x 4 matrix, row by row.
//
// Reading throws nlohmann::json::exception where a key is missing or of another kind.
#ifndef LUXFIT_APPS_STAGES_REGISTRATION_JSON_H_
#define LUXFIT_APPS_STAGES_REGISTRATION_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/stages.h"

namespace luxfit {

// `session` for the cameras' ids.
nlohmann::json RegistrationJson(const Session& session, const RegisteredSession& registered);
RegisteredSession RegistrationFromJson(const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_REGISTRATION_JSON_H_
