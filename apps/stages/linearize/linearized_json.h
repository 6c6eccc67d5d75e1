// Writes linearized photos as JSON, and reads them back.
//
// Reading throws nlohmann::json::exception where a key is missing or has another type.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_
#define LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/linearize/linearized_session.h"

namespace luxfit {

// Writes photos with their brackets, and cameras with response, vignetting and full scale.
nlohmann::json LinearizedJson(const LinearizedPhotos& linearized);
// `session` gives the cameras as they were read.
LinearizedPhotos LinearizedFromJson(const Session& session, const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_LINEARIZED_JSON_H_
