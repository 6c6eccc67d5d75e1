// Lays registrations without a tag survey onto the session's mesh, from rough places of the cameras.
//
// Where this fails, the Registration is not usable and its message gives the reason. Throws
// std::runtime_error("FILE: key: expected ..., got ...; remedy") where the session gives no start or no mesh.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_LAY_ON_MESH_H_
#define LUXFIT_APPS_STAGES_INTERNAL_LAY_ON_MESH_H_

#include <vector>

#include "apps/session/session.h"
#include "calib/lens/camera.h"
#include "calib/register/feature_model.h"
#include "calib/register/registration.h"

namespace luxfit {

// Uses features alone: their points on the mesh give frame and scale.
Registration RegisterOnMesh(const Session& session, const std::vector<Camera>& cameras,
                            const std::vector<ViewDetections>& views, const FeatureModel& features);

// Uses unsurveyed tags: their corners lie on the mesh, and their size is the scale.
Registration LaidOnMesh(const Session& session, const Registration& registration);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_LAY_ON_MESH_H_
