// Returns the cameras of a session's photos, with poses where something tells them: tags or a model of COLMAP.
//
// Throws as registration does (apps/stages/stages.h), and std::runtime_error where neither intrinsics nor images
// tell a camera's lens.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_SESSION_CAMERAS_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_SESSION_CAMERAS_H_

#include "apps/stages/stages.h"

namespace luxfit {

RegisteredSession CamerasWithPoses(const Session& session, const LinearizedPhotos& photos,
                                   RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_SESSION_CAMERAS_H_
