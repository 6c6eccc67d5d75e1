// Asks for every cell of a plane whether views see a surface there that the mesh lacks.
//
//   +1   `fewest_views` or more agree on it, at least 60 % of those that face it, and the mesh explains at most half
//        of their pixels
//   -1   as many views face it, and see something else there
//    0   fewer views face it
//
// A view faces a cell where it looks at the plane's front by more than 9 degrees and no mesh lies before it.
// Source: Collins (1996), "A space-sweep approach to true multi-image matching", with signatures (signature_view.h)
// in place of features.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_PLANE_SWEEP_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_PLANE_SWEEP_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "inverse/furniture/internal/largest_rectangle.h"
#include "inverse/furniture/internal/mesh_agreement.h"

namespace luxfit {

constexpr int kMostViews = 64;  // bits of a set of views

// Holds what all planes share. Views beyond the first kMostViews take no part.
struct SweptViews {
  const std::vector<SignatureView>& views;
  const std::vector<MeshAgreement>& mesh;
  std::vector<Eigen::Vector3d> eyes;
  double tolerance;  // of signatures
  int fewest_views;  // that agree: 2 or more
};

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

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_PLANE_SWEEP_H_
