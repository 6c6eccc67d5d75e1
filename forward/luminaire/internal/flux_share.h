// Where a luminaire's flux goes: below the horizontal, and straight onto the floor of empty rooms.
//
//   share = (1 / Phi) int I(C, gamma) P(C, gamma) dOmega
// with P = 1 below the horizontal for the downward share, and for the direct ratio of a square room of side a
// whose luminaires are spread evenly over a plane at height h above its floor
//   P = (1 - h tan(gamma) |cos C| / a) (1 - h tan(gamma) |sin C| / a), 0 where a factor is negative:
// the share of places in that plane from which the direction meets the floor before a wall. Room index
// k = a / (2 h).
//
// Shares are of the luminaire's whole flux, 0 to 1. By Gauss-Legendre in gamma within the table's cells
// and the midpoint rule in C: 1e-3. Makers tabulate direct ratios for other grids of luminaires in rooms that
// are not square: theirs differ by some hundredths in small rooms.
// Sources: Stockmar (1990), "EULUMDAT", lines 22 and 27; CIE 52-1982 (room index, direct ratio).
#ifndef LUXFIT_FORWARD_LUMINAIRE_INTERNAL_FLUX_SHARE_H_
#define LUXFIT_FORWARD_LUMINAIRE_INTERNAL_FLUX_SHARE_H_

#include <array>

#include "forward/luminaire/photometry.h"

namespace luxfit {

// k of the rooms that EULUMDAT names.
constexpr std::array<double, 10> kRoomIndices{0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5};

struct FluxShares {
  double downward = 0;
  std::array<double, kRoomIndices.size()> direct_ratio{};
};

// Throws std::invalid_argument for a table without flux, or about another axis than the luminaire's: resample
// that first.
FluxShares FluxSharesOf(const IntensityTable& table);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LUMINAIRE_INTERNAL_FLUX_SHARE_H_
