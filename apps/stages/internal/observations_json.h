// Observations as JSON with binary columns (for CBOR) and back: bit by bit the same.
//
// Reading throws nlohmann::json::exception where a key is missing or of another kind.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_OBSERVATIONS_JSON_H_
#define LUXFIT_APPS_STAGES_INTERNAL_OBSERVATIONS_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/stages.h"

namespace luxfit {

nlohmann::json ObservationsJson(const SessionObservations& observed);
SessionObservations ObservationsFromJson(const nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_OBSERVATIONS_JSON_H_
