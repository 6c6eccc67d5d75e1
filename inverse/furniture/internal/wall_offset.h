// Estimates by how much a plane stands off, from what views differ in along its normal, and decides whether it does.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_WALL_OFFSET_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_WALL_OFFSET_H_

#include <optional>

#include "inverse/furniture/internal/offset_sweep.h"

namespace luxfit {

struct WallOffset {
  double by_m = 0, sigma_m = 0;
  double gain = 0;  // of loss against that at the mesh
  int views = 0;    // that differ less there
};

// Returns where the plane stands; nothing where it may stand where the mesh has it (inverse/furniture/moved_walls.h).
std::optional<WallOffset> EstimateOffset(const HullPlane& plane, const SweptOffsets& swept);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_WALL_OFFSET_H_
