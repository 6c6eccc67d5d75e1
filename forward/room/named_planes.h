// Tells whether a scene's materials are planes that LayOnPlanes named, because the mesh has no materials.
//
// They are where the scene is a surface on planes and each material is called as LayOnPlanes calls them ("floor", "ceiling",
// "wall 1", "surface 1", "details 1", ...; forward/room/planes.h), numbered from 1 in their order. Boxes that photos show
// ("found 1", ...) may stand among them.
#ifndef LUXFIT_FORWARD_ROOM_NAMED_PLANES_H_
#define LUXFIT_FORWARD_ROOM_NAMED_PLANES_H_

#include "forward/room/scene.h"

namespace luxfit {

bool AreNamedPlanes(const Scene& scene);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_NAMED_PLANES_H_
