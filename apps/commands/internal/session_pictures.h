// Writes the luminance pictures of `luxfit linearize --hdr`, in the frame of the session where it has tags or a model
// of COLMAP.
//
// Adds a warning ("luminance_clipped") where pixels are saturated. Throws as CamerasWithPoses does
// (apps/commands/internal/session_cameras.h).
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_SESSION_PICTURES_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_SESSION_PICTURES_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/stages.h"

namespace luxfit {

// Writes OUT/luminance/VIEW_STATE.hdr and .exr; returns `pictures` of stages/linearize.json.
nlohmann::json WriteSessionPictures(const Session& session, const LinearizedPhotos& photos,
                                    RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_SESSION_PICTURES_H_
