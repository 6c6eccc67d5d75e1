// Finds pieces of furniture that the mesh has and the room has not, or has elsewhere.
//
//   missing: through_m2 >= kLeastThroughM2 and through_m2 >= kLeastThroughShare judged_m2     (internal/see_through.h)
//   its new place = argmax over shifts d along the floor of (cells that views agree on - cells where they see something
//                   else), near boxes that views show in the mesh without the piece
//
// A piece is facets off the room's bounding box, joined (forward/changes/pieces.h). It keeps its faces, its turn and its
// material where it moved.
//
// Metres, world frame. Pieces that mirror, flat ones on walls, and what fewer than three views see, stay where they are.
// Source: own; votes as in furniture.h.
#ifndef LUXFIT_INVERSE_FURNITURE_MISSING_PIECES_H_
#define LUXFIT_INVERSE_FURNITURE_MISSING_PIECES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "forward/changes/pieces.h"
#include "forward/room/scene.h"
#include "inverse/furniture/furniture.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

struct MissingPiece {
  std::string material;                  // of most of its area
  PieceMove move;                        // where the mesh has it, and to where it moved
  double judged_m2 = 0, through_m2 = 0;  // of its faces: three views or more see them; they see through them
  int views = 0;                         // that see through it
};

struct RevisedFurniture {
  std::vector<MissingPiece> missing;  // the largest first
  std::vector<FoundBox> found;
};

// Finds missing pieces of the mesh, then boxes that the rest of it lacks, and the missing pieces among them. `room` is
// the mesh as light sees it (LayOnPlanes): boxes are sought in it where no piece is missing.
RevisedFurniture ReviseFurniture(const Scene& mesh, const Scene& room,
                                 const std::vector<SignatureView>& views,
                                 const FurnitureOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_MISSING_PIECES_H_
