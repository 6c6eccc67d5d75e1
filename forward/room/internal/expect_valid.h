// Checks a programmer's input where it enters: finite numbers, facets that have an area.
//
// A NaN or a facet without a normal would spread silently, or end the program inside the ray tracer.
// Functions that take whole scenes, lists of luminaires or sensors check them. The light of one luminaire at
// one point (DirectIlluminancePerLumen and its kin) is the innermost loop and checks nothing: there NaN in is
// NaN out.
//
// Throws std::invalid_argument that names the facet and what is wrong with it.
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_EXPECT_VALID_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_EXPECT_VALID_H_

#include <string>

#include "forward/room/scene.h"

namespace luxfit {

// Throws std::invalid_argument("OF: expected WHAT") unless `holds`.
void ExpectThat(bool holds, const std::string& of, const char* what);

// Checks that every facet has finite corners, an area above 0 and a material of the scene.
void ExpectValid(const Scene& scene);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_EXPECT_VALID_H_
