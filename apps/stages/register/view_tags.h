// Groups a session's photos of each view and detects the tags in them (calib/register/view_tags.h).
#ifndef LUXFIT_APPS_STAGES_REGISTER_VIEW_TAGS_H_
#define LUXFIT_APPS_STAGES_REGISTER_VIEW_TAGS_H_

#include <map>
#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/stages/stages.h"
#include "calib/lens/camera.h"
#include "calib/register/registration.h"

namespace luxfit {

// Returns at most six photos a view, those with the most luminaires on first. `Photo` is SessionPhoto or
// LinearizedPhoto; the session gives the states.
template <typename Photo>
std::map<std::string, std::vector<const Photo*>> PhotosByView(const Session& session,
                                                              const std::vector<Photo>& photos);
using ViewPhotos = std::map<std::string, std::vector<const LinearizedPhoto*>>;

struct DetectedViews {
  std::vector<ViewDetections> views;   // in the order of ViewPhotos
  std::vector<MisplacedPhoto> photos;  // they show other views; their tags are in none
};

// Detects tags in every photo of a view, refines and combines them. `views` are of `photos`.
DetectedViews DetectViews(const Session& session, const LinearizedPhotos& photos,
                          const std::vector<Camera>& cameras, const ViewPhotos& views,
                          const RunContext& context);

// Returns whether the session says what tags there are.
bool HasTags(const Session& session);

// Returns the same entries without tags.
std::vector<ViewDetections> ViewsWithoutTags(const ViewPhotos& views);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_REGISTER_VIEW_TAGS_H_
