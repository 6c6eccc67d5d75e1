// Sets the photos of a drafted session: views, states, cameras and tags.
//
// Names tell views and states where they can (apps/session/photos/photo_names.h). Otherwise what the photos show does
// (apps/session/photos/photo_groups.h).
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_DRAFT_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_DRAFT_H_

#include <string>

#include "apps/session/session_draft.h"

namespace luxfit {

// `photos` is the folder of the photos, `out` that of the session. Throws std::runtime_error for a folder without photos,
// and for a photo that cannot be read.
void DraftPhotos(const std::string& photos, const std::string& out, SessionDraft& draft);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_DRAFT_H_
