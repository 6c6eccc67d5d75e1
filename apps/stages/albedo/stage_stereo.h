// Runs photometric stereo on a session of an object ([lights]).
//
// Writes OUT/normals.exr (x right, y up, z towards the camera) and OUT/albedo.exr (albedo, its sigma, the
// normal's sigma in rad; 0 where nothing is determined). OUT/lights.csv lists for each light what was
// adjusted and what remains; OUT/stages/albedo.json is the artifact.
//
// Throws std::runtime_error for masks and photos that differ in size, and for a mirror sphere that is not a
// sphere.
#ifndef LUXFIT_APPS_STAGES_ALBEDO_STAGE_STEREO_H_
#define LUXFIT_APPS_STAGES_ALBEDO_STAGE_STEREO_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/stages/stages.h"

namespace luxfit {

// Returns the artifact. `session` must have lights.
nlohmann::json StereoSession(const Session& session, const LinearizedPhotos& linearized, RunContext& context);

// Return OUT/result.json of the artifact, and its text.
nlohmann::json StereoResultJson(const Session& session, const nlohmann::json& artifact,
                                const RunContext& context);
std::string StereoTable(const nlohmann::json& result);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_ALBEDO_STAGE_STEREO_H_
