// Writes observations as JSON with binary columns (for CBOR) and reads them back bit by bit.
//
// The covariance of poses is not among them: the registration holds it (PoseErrorsOf).
//
// Reading throws nlohmann::json::exception where a key is missing or has another type.
#ifndef LUXFIT_APPS_STAGES_OBSERVE_OBSERVATIONS_JSON_H_
#define LUXFIT_APPS_STAGES_OBSERVE_OBSERVATIONS_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/stages.h"

namespace luxfit {

nlohmann::json ObservationsJson(const Evidence& observed);
Evidence ObservationsFromJson(const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_OBSERVATIONS_JSON_H_
