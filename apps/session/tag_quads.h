// Where a session's tags cover a photo: no surface of the room is seen there.
#ifndef LUXFIT_APPS_SESSION_TAG_QUADS_H_
#define LUXFIT_APPS_SESSION_TAG_QUADS_H_

#include <vector>

#include "apps/session/session.h"
#include "calib/lens/camera.h"
#include "inverse/observe/observe.h"

namespace luxfit {

// Of the surveyed tags in front of the camera, with their paper.
std::vector<PixelQuad> TagQuads(const Session& session, const Camera& camera,
                                const Eigen::Isometry3d& cam_from_world);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_TAG_QUADS_H_
