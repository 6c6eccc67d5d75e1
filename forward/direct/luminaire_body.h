// Treats luminaires as things in the room: bodies that shade and absorb, and the share that stands outside.
//
// WithLuminaireBodies: a disc or rectangle that shines to one side only gets two opaque black facets 0.1 and
// 0.2 mm behind its luminous surface, the first facing where it shines, the second away; a disc as a regular
// 12-gon of its area. Reflectance 0 is what renderers give an emitter. A diffuser of reflectance 0.7 instead
// of a white ceiling would take back a tenth of that. In a room of 80 m2 a panel of 0.36 m2 takes 1 % of the
// interreflected light. Luminaires that shine to both sides, points and spheres get none.
//
// ShareOutsideRoom judges points of the luminous surface (forward/room/in_room.h).
//
// Both throw std::invalid_argument for a luminaire that is not valid.
// Source: radiance of emitters in Ward Larson and Shakespeare (1998), "Rendering with Radiance", sec. 5.
#ifndef LUXFIT_FORWARD_DIRECT_LUMINAIRE_BODY_H_
#define LUXFIT_FORWARD_DIRECT_LUMINAIRE_BODY_H_

#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

// Names the material of the facets added, last in the scene's list; none is added where there are no facets.
constexpr char kLuminaireBodyMaterial[] = "(luminaire)";

// Returns the scene with the bodies of flat luminaires.
Scene WithLuminaireBodies(Scene scene, const std::vector<Luminaire>& luminaires);

// Returns the share of the luminaire's surface (0 to 1) that is in a solid or beyond a wall; 1 in an empty
// scene.
double ShareOutsideRoom(const RayScene& rays, const Luminaire& luminaire);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_LUMINAIRE_BODY_H_
