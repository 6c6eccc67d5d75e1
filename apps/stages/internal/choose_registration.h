// How a session's views are registered: by what the session asks for, or by the simplest that does.
//
// auto: tags, where they register every view; else tags and features together if that registers more, where
// the session names a COLMAP model or COLMAP is installed. Without a tag map or tag size there are only
// features, laid onto the mesh from the session's start. colmap: the same where there is a start; else tags
// give frame and scale as in both. The choice, and why, goes into the context's choices.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_CHOOSE_REGISTRATION_H_
#define LUXFIT_APPS_STAGES_INTERNAL_CHOOSE_REGISTRATION_H_

#include <vector>

#include "apps/stages/stages.h"
#include "apps/stages/view_tags.h"

namespace luxfit {

// Throws std::runtime_error where the session asks for what it does not give, MissingProgram where COLMAP is
// asked for and not installed.
Registration ChooseRegistration(const Session& session, const std::vector<Camera>& cameras,
                                const ViewPhotos& views, RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_CHOOSE_REGISTRATION_H_
