// Sums the light of a rectangle with uneven emission over its cells.
//
// The cells move and turn with the luminaire, and their size is a part of its size. The result is per lm of
// the whole.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_CELL_SUM_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_CELL_SUM_H_

#include "forward/direct/direct_light.h"
#include "forward/direct/internal/luminous_surface.h"
#include "forward/luminaire/luminaire_parts.h"

namespace luxfit {

// Sums `light(cell)`, the DirectIlluminance per lm of one cell.
template <typename Light>
DirectIlluminance SumOverCells(Luminaire luminaire, const Light& light) {
  luminaire.flux_lm = 1;
  const LuminousSurface surface(luminaire);
  const Eigen::Vector2d cells(static_cast<double>(luminaire.emission.rows()),
                              static_cast<double>(luminaire.emission.cols()));
  DirectIlluminance sum;
  for (const LuminaireCell& cell : CellsOf(luminaire)) {
    const DirectIlluminance one = light(cell.luminaire);
    DirectIlluminance own = one;
    own.d_position.setZero();
    own.d_size = one.d_size.cwiseQuotient(cells);
    surface.AddMotion(cell.place, one.d_position, own);
    sum.AddScaled(cell.luminaire.flux_lm, own);
  }
  return sum;
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_CELL_SUM_H_
