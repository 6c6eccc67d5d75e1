// Lists the lobes that the search for luminaires tries: widths and aims, with no luminaire's name.
//
// Simple lobes are isotropic, or aimed along an axis of the room. Where a place is known, or seen in photos, a lobe that
// shines up and down alike is tried, too, as pendants do: a lobe to one side, or to all, explains their light best at
// another height. Aimed lobes are cosine powers of three widths, whose aims cover the sphere: the 42 vertices of an
// icosahedron with divided edges, 32 to 36 degrees apart. The search refines an aimed lobe by its neighbours: six aims
// around it and both next widths.
//
//   I = (m + 1) cos^m(gamma) / (2 pi) cd per lm        half of the peak at cos(gamma) = 2^(-1 / m)
//   I = (1 - b) cos(gamma) / pi                        to both sides; b: share of the flux to the back
//   I = b |cos(gamma)| / pi                            on the back
//
// Source: forward/luminaire/luminaire.h (intensities).
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LOBES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LOBES_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "forward/luminaire/luminaire.h"

namespace luxfit {

struct Lobe {
  Distribution distribution = Distribution::kCosinePower;
  double exponent = 1;
  Eigen::Vector3d aim{0, 0, -1};
  // Share of the flux to the side that the aim leaves. Where it is not 0, the exponent is 1.
  double share_back = 0;
};

const std::vector<Lobe>& SimpleLobes();
// Returns the simple lobes and the one that shines up and down: at a place in mid-air it may imitate two luminaires.
const std::vector<Lobe>& LobesOfKnownPlaces();
// Return those of them that shine straight down, with a beam of half that width (22: half of its peak lies 14 degrees off), and, in
// mid-air, those to all sides and to both, of which more or less is up.
const std::vector<Lobe>& LobesUnderCeiling();
const std::vector<Lobe>& LobesInMidAir();

// Unit vectors.
const std::vector<Eigen::Vector3d>& AimsOverSphere();
constexpr double kAimStepRad = 0.6;  // between neighbours of AimsOverSphere

// Exponents of aimed lobes. Half of the peak lies 45, 23 and 12 degrees off the aim; the next narrower width and
// the distance of two aims leave no beam without a lobe that shows half of its peak.
constexpr std::array<double, 3> kAimedExponents{2, 8, 32};
double HalfPeakCosine(double exponent);

// Returns a lobe and its neighbours: aims `turn_rad` off, exponents times and over `width_factor`. An isotropic
// lobe has none.
std::vector<Lobe> LobesNear(const Lobe& lobe, double turn_rad, double width_factor);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LOBES_H_
