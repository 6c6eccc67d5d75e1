// Chooses how a session's views are registered: as the session asks, or by the simplest method that succeeds.
//
// auto: tags where they register every view; else tags and features together if that registers more, where
// the session names a COLMAP model or COLMAP is installed. Without a tag map or tag size only features
// remain, laid onto the mesh from the session's start. colmap: the same where there is a start; else tags
// give frame and scale as in both. The choice and its reason are added to the context's choices.
#ifndef LUXFIT_APPS_STAGES_REGISTER_CHOOSE_REGISTRATION_H_
#define LUXFIT_APPS_STAGES_REGISTER_CHOOSE_REGISTRATION_H_

#include <vector>

#include "apps/stages/register/view_tags.h"
#include "apps/stages/stages.h"

namespace luxfit {

// Throws std::runtime_error where the session asks for what it does not give, and MissingProgram where COLMAP
// is asked for and not installed.
// `detections`: the tags of `views`, in their order.
Registration ChooseRegistration(const Session& session, const LinearizedPhotos& photos,
                                const std::vector<Camera>& cameras, const ViewPhotos& views,
                                std::vector<ViewDetections> detections, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_REGISTER_CHOOSE_REGISTRATION_H_
