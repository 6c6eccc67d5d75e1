// Estimates the albedo of a room's surfaces after the fit: by material, patch or element, as finely as the
// photos support.
//
// Writes OUT/albedo.csv and OUT/stages/albedo.json. A material with a single albedo keeps that of the fit,
// whose covariance is that of everything fitted. Finer albedos come from measured radiosity
// (inverse/albedo/patch_albedo.h).
#ifndef LUXFIT_APPS_STAGES_ALBEDO_STAGE_ALBEDO_H_
#define LUXFIT_APPS_STAGES_ALBEDO_STAGE_ALBEDO_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/stages/stages.h"

namespace luxfit {

// Returns the artifact. `result` (ResultJson) has the materials as fitted.
nlohmann::json AlbedoOfRoom(const Session& session, const Room& room, const RoomFit& fit,
                            const nlohmann::json& result, RunContext& context);

// Adds what the artifact holds of the materials to `result`.
nlohmann::json WithAlbedo(nlohmann::json result, const nlohmann::json& artifact, const RunContext& context);

std::string AlbedoTable(const nlohmann::json& result);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_ALBEDO_STAGE_ALBEDO_H_
