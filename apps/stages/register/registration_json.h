// Writes cameras and poses as JSON and reads them back, as OUT/stages/register.json holds them beside its
// provenance.
//
// Everything is kept except what only the registration itself needs (`notes` return as they were written). A
// camera is {"id", "width_px", ..., "distortion", "lens", "spline"}. A pose `cam_from_world` is the twelve
// numbers of a 3 x 4 matrix, row by row. `pose_covariance` is the lower triangle of the covariance of all poses,
// row by row in one list. Sigmas that are not known are NaN and are written as null.
//
// Reading throws nlohmann::json::exception where a key is missing or has another type.
#ifndef LUXFIT_APPS_STAGES_REGISTER_REGISTRATION_JSON_H_
#define LUXFIT_APPS_STAGES_REGISTER_REGISTRATION_JSON_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// The same in register.json and result.json.
nlohmann::json MisplacedJson(const std::vector<MisplacedPhoto>& photos);

// `session` gives the cameras' ids.
nlohmann::json RegistrationJson(const Session& session, const RegisteredSession& registered);
RegisteredSession RegistrationFromJson(const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_REGISTER_REGISTRATION_JSON_H_
