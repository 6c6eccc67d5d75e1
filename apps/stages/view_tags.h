// The photos of each view, and the tags they show.
#ifndef LUXFIT_APPS_STAGES_VIEW_TAGS_H_
#define LUXFIT_APPS_STAGES_VIEW_TAGS_H_

#include <map>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/stages/stages.h"
#include "calib/lens/camera.h"
#include "calib/register/registration.h"

namespace luxfit {

// By view; those with the most luminaires on first (evenly lit tags), at most six.
using ViewPhotos = std::map<std::string, std::vector<const SessionPhoto*>>;
ViewPhotos PhotosByView(const Session& session);

// Detected in every photo of a view, refined, and combined; one entry a view, in that order.
std::vector<ViewDetections> DetectViews(const Session& session, const std::vector<Camera>& cameras,
                                        const ViewPhotos& views, const RunContext& context);

// The same entries without looking for tags.
std::vector<ViewDetections> ViewsWithoutTags(const ViewPhotos& views);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_VIEW_TAGS_H_
