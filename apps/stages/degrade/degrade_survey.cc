#include <stdexcept>

#include "apps/stages/degrade/degradation_rows.h"
#include "apps/stages/register/view_tags.h"
#include "inverse/observe/scene_surface.h"
#include "inverse/study/degrade.h"

namespace luxfit {
namespace {

std::optional<std::string> NeedsSurveyedTags(const UndegradedSession& whole) {
  for (const RegisteredView& view : whole.prepared.registered.registration.views) {
    if (MethodOf(view) != "tags") return "views are registered by more than tags";
  }
  if (whole.prepared.session.tags.survey.empty() || whole.observed.observations.empty())
    return "no surveyed tags are used";
  return std::nullopt;
}

// Registers and observes the views again.
void MoveTags(UndegradedSession& whole, double sigma_mm, std::mt19937_64& rng, DegradedCase& c) {
  const std::vector<Camera>& cameras = whole.prepared.registered.cameras;
  const LinearizedPhotos& photos = c.linearized.photos;
  if (!whole.detections)
    whole.detections =
        DetectViews(c.session, photos, cameras, PhotosByView(c.session, photos.photos), c.context).views;
  c.session.tags.survey = WithMovedTags(c.session.tags.survey, sigma_mm / 1000, rng);
  RegisteredSession registered;
  registered.cameras = cameras;
  RegisterViewsOptions options;
  options.surface = SurfaceOf(c.room->scene);
  registered.registration = RegisterViews(cameras, c.session.tags.survey, *whole.detections, options);
  for (const RegistrationNote& note : registered.registration.notes)
    c.context.warnings.push_back({note.code, note.message, note.remedy});
  if (!registered.registration.IsUsable())
    throw std::runtime_error("no view has a pose: " + registered.registration.message);
  const std::vector<double>& focal_scale = registered.registration.focal_scale;
  for (size_t i = 0; i < focal_scale.size(); ++i) {
    if (focal_scale[i] == 1) continue;
    registered.cameras[i] = WithFocalScale(cameras[i], focal_scale[i]);
    c.context.warnings.push_back({"focal_length_off", "the tags contradict the focal length", ""});
  }
  c.observed = Thinned(ObserveSession(c.session, photos, registered, *c.room, c.context), whole.max_elements);
}

}  // namespace

Degradation TagsMoved() {
  const std::vector<double> levels = {1, 3, 10, 30, 100};
  return {"tags_moved",      "mm",    "error of each tag's place along each axis, mm", levels, true,
          NeedsSurveyedTags, MoveTags};
}

}  // namespace luxfit
