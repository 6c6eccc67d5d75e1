// Photometric stereo on a session of an object ([lights]).
//
// Writes OUT/normals.exr (x right, y up, z towards the camera), OUT/albedo.exr (albedo, its sigma, the
// normal's sigma in rad; 0 where nothing is determined), OUT/lights.csv (light by light: what was adjusted
// and what is left) and OUT/stages/albedo.json.
//
// Throws std::runtime_error for masks and photos that differ in size, and a mirror sphere that is none.
#ifndef LUXFIT_APPS_STAGES_STAGE_STEREO_H_
#define LUXFIT_APPS_STAGES_STAGE_STEREO_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/stages/stages.h"

namespace luxfit {

// The artifact; `session` is linearized.
nlohmann::json StereoSession(const Session& session, RunContext& context);

// OUT/result.json of it, and as text.
nlohmann::json StereoResultJson(const Session& session, const nlohmann::json& artifact,
                                const RunContext& context);
std::string StereoTable(const nlohmann::json& result);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGE_STEREO_H_
