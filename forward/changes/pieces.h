// Finds the pieces of furniture of a mesh, leaves facets out, and moves pieces.
//
//   piece = facets that are no wall, floor or ceiling of the scene's bounding box, joined where they share a corner
//
// A facet on the bounding box that faces outwards is the back or the bottom of a piece. Corners within 20 um are one.
// Inner walls of a room that is no box are a piece, too: whoever removes one has to see that the room stays closed.
// Metres, world frame. Source: own.
#ifndef LUXFIT_FORWARD_CHANGES_PIECES_H_
#define LUXFIT_FORWARD_CHANGES_PIECES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

// Returns pieces as indices into scene.facets, ascending, one list for each piece.
std::vector<std::vector<int>> LoosePieces(const Scene& scene);

// Returns the bounds of such facets.
Eigen::AlignedBox3d BoundsOf(const Scene& scene, const std::vector<int>& facets);

// Returns the scene without these facets, and without materials that then have none.
Scene WithoutFacets(const Scene& scene, const std::vector<int>& facets);

struct PieceMove {
  Eigen::AlignedBox3d bounds;                // of the piece in the mesh
  std::optional<Eigen::Vector3d> by_m = {};  // absent: the piece is left out
};
// Moves the pieces that have these bounds to 1 mm, or leaves them out.
Scene WithPiecesMoved(Scene scene, const std::vector<PieceMove>& moves);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_CHANGES_PIECES_H_
