// Gives registration the surfaces of a scene, on which surveyed tags hang.
#ifndef LUXFIT_INVERSE_OBSERVE_SCENE_SURFACE_H_
#define LUXFIT_INVERSE_OBSERVE_SCENE_SURFACE_H_

#include "calib/register/registration.h"
#include "forward/room/scene.h"

namespace luxfit {

// Returns the facets of a scene as triangles; those of a parallelogram are two. World frame, m.
TriangleSurface SurfaceOf(const Scene& scene);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_SCENE_SURFACE_H_
