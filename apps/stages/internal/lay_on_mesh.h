// Registrations that no tag survey places, laid onto the session's mesh from where the cameras roughly stood.
//
// What cannot be laid comes back as a Registration that is not usable, its message says why.
// Throws std::runtime_error("FILE: key: expected ..., got ...; mend") where the session gives no start or no
// mesh.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_LAY_ON_MESH_H_
#define LUXFIT_APPS_STAGES_INTERNAL_LAY_ON_MESH_H_

#include <vector>

#include "apps/session/session.h"
#include "calib/lens/camera.h"
#include "calib/register/feature_model.h"
#include "calib/register/registration.h"

namespace luxfit {

// Features alone: their points on the mesh give frame and scale.
Registration RegisterOnMesh(const Session& session, const std::vector<Camera>& cameras,
                            const std::vector<ViewDetections>& views, const FeatureModel& features);

// Unsurveyed tags: their corners lie on the mesh, their size is the scale.
Registration LaidOnMesh(const Session& session, const Registration& registration);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_LAY_ON_MESH_H_
