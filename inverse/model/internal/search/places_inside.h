// Moves places that photos show into the room: a luminaire hangs inside, whatever the error of the place. Above the ceiling it would
// light nothing.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_PLACES_INSIDE_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_PLACES_INSIDE_H_

#include <Eigen/Geometry>
#include <vector>

#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

// Returns the place; one outside the box, 5 mm inside it. m.
Eigen::Vector3d Inside(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& place);

// Returns the places, those outside the box 5 mm inside it. `box`: of the room (m, world); empty: there is no mesh.
std::vector<SeenPlace> PlacesInside(const Eigen::AlignedBox3d& box, std::vector<SeenPlace> places);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_PLACES_INSIDE_H_
