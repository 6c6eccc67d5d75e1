#include "apps/commands/internal/session_cameras.h"

#include <fmt/format.h>

#include "apps/stages/calibrate/calibration_images.h"
#include "apps/stages/calibrate/stage_calibrate.h"
#include "apps/stages/prepared_session.h"
#include "apps/text/input_error.h"

namespace luxfit {
namespace {

bool CanBeRegistered(const Session& session) {
  const bool has_tags = !session.tags.survey.empty() || session.tags.size_m > 0;
  return !session.lights && (has_tags || !session.registration.colmap_model.empty());
}

void ExpectLenses(const Session& session) {
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const SessionCamera& camera = session.cameras[c];
    if (camera.intrinsics.empty() && !CanBeCalibrated(session, camera))
      throw InputError({session.path, camera.line}, fmt::format("camera[{}].intrinsics", c),
                       "expected the lens, which tells where each pixel looks, got none; add intrinsics = "
                       "\"FILE\", or calibration_images and board");
  }
}

}  // namespace

RegisteredSession CamerasWithPoses(const Session& session, const LinearizedPhotos& photos,
                                   RunContext& context) {
  if (CanBeRegistered(session)) return RegisterKept(session, photos, InputsOfStages(session, ""), context);
  ExpectLenses(session);
  RegisteredSession cameras_alone;
  cameras_alone.cameras = CamerasOf(session, photos, context);
  return cameras_alone;
}

}  // namespace luxfit
