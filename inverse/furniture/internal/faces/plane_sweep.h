// Asks for every cell of a plane whether views see a surface there that the mesh lacks (cell_judge.h).
//
// Source: Collins (1996), "A space-sweep approach to true multi-image matching", with signatures (signature_view.h)
// in place of features.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_PLANE_SWEEP_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_PLANE_SWEEP_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "inverse/furniture/internal/cell_judge.h"
#include "inverse/furniture/internal/faces/largest_rectangle.h"

namespace luxfit {

// A rectangle of square cells, world frame: corner + (column + 1/2) cell along + (row + 1/2) cell across.
struct SweptPlane {
  Eigen::Vector3d corner, along, across, normal;
  double cell_m = 0.08;
  int columns = 0, rows = 0;

  Eigen::Vector3d CenterOf(int row, int column) const {
    return corner + (column + 0.5) * cell_m * along + (row + 0.5) * cell_m * across;
  }
};

struct PlaneVotes {
  VoteGrid votes;
  std::vector<std::uint64_t>
      views;  // of each cell, row by row: those that agree and that the mesh does not explain
};

PlaneVotes Sweep(const SweptViews& swept, const SweptPlane& plane);
// Votes again on the cells that were +1, once the mesh explains more.
void SweepAgain(const SweptViews& swept, const SweptPlane& plane, PlaneVotes& votes);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_PLANE_SWEEP_H_
