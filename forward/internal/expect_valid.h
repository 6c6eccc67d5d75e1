// What the programmer gives, checked where it enters: numbers that are finite, facets that have an area.
//
// A NaN or a facet without a normal would spread silently, or end the program inside the ray tracer. Checked
// by what takes whole scenes, lists of luminaires or sensors; the light of one luminaire at one point
// (DirectIlluminancePerLumen and its kin), the innermost loop, is not: there NaN in is NaN out.
// All throw std::invalid_argument that names the facet or luminaire, and what is wrong with it.
#ifndef LUXFIT_FORWARD_INTERNAL_EXPECT_VALID_H_
#define LUXFIT_FORWARD_INTERNAL_EXPECT_VALID_H_

#include <vector>

#include "forward/luminaire.h"
#include "forward/scene.h"
#include "forward/sensor.h"

namespace luxfit {

// Every facet: finite corners, an area above 0, a material of the scene.
void ExpectValid(const Scene& scene);

// Finite numbers, an aim, a size >= 0, an exponent above 0 and a table where the distribution has them.
void ExpectValid(const Luminaire& luminaire);
void ExpectValid(const std::vector<Luminaire>& luminaires);

// Finite numbers and a normal.
void ExpectValid(const Sensor& sensor);
void ExpectValid(const std::vector<Sensor>& sensors);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_INTERNAL_EXPECT_VALID_H_
