// Flat luminaires as things in the room: opaque and black, so that they shade and absorb.
//
// A disc or rectangle that shines to one side only gets two facets 0.1 and 0.2 mm behind its luminous
// surface, the first facing where it shines, the second away; a disc as a regular 12-gon of its area.
// Reflectance 0 is what renderers give an emitter; a diffuser of reflectance 0.7 instead of a white ceiling
// would take back a tenth of that. In a room of 80 m2 a panel of 0.36 m2 takes 1 % of the interreflected
// light. Luminaires that shine to both sides, points and spheres get none. Source: radiance of emitters in
// Ward Larson and Shakespeare (1998), "Rendering with Radiance", sec. 5.
#ifndef LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_BODY_H_
#define LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_BODY_H_

#include <vector>

#include "forward/luminaire/luminaire.h"
#include "forward/room/scene.h"

namespace luxfit {

// The material of the facets added, last in the scene's list; none where there is nothing to add.
constexpr char kLuminaireBodyMaterial[] = "(luminaire)";

Scene WithLuminaireBodies(Scene scene, const std::vector<Luminaire>& luminaires);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_LUMINAIRE_BODY_H_
