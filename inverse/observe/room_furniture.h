// Looks in the photos of registered views for walls that stand elsewhere than the mesh has them, then in the room that
// they leave for furniture: what the mesh lacks, or has where the room has none; and on its walls for parts of other paint. Before, whether the whole mesh lies
// otherwise than the room.
//
//   photos of a view in every state -> SignatureView -> FindMeshAsIf; WithoutGains -> FindMovedWalls, ReviseFurniture, FindPaintedParts -> change -> mesh with the change
//
// Nothing is looked for where fewer than three views are registered. Metres, world frame.
// Source: inverse/furniture/moved_walls.h, inverse/furniture/missing_pieces.h, inverse/furniture/painted_parts.h.
#ifndef LUXFIT_INVERSE_OBSERVE_ROOM_FURNITURE_H_
#define LUXFIT_INVERSE_OBSERVE_ROOM_FURNITURE_H_

#include <Eigen/Core>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/register/registration.h"
#include "calib/targets/tags.h"
#include "forward/changes/painted_rectangles.h"
#include "forward/changes/pieces.h"
#include "forward/changes/plane_moves.h"
#include "forward/mesh/outline.h"
#include "forward/room/scene.h"
#include "inverse/furniture/missing_pieces.h"
#include "inverse/furniture/moved_walls.h"
#include "inverse/furniture/painted_parts.h"
#include "inverse/observe/as_if/mesh_as_if.h"
#include "inverse/observe/room_photos.h"

namespace luxfit {

struct FurnitureChange {
  std::vector<RoomBox> boxes;           // that the mesh lacks
  std::vector<PieceMove> moves;         // of pieces that the mesh has elsewhere
  std::vector<PlaneMove> walls;         // that the mesh has elsewhere, in the order in which they move
  std::vector<PaintedRectangle> parts;  // of walls, painted otherwise than the mesh has it
  bool IsEmpty() const { return boxes.empty() && moves.empty() && walls.empty() && parts.empty(); }
};

struct RevisedRoom {
  std::vector<MeshExplanation> mesh_as_if;  // where there are some, nothing else is looked for
  std::vector<MovedWall> walls;
  RevisedFurniture furniture;
  std::vector<PaintedPart> parts;
};

// `mesh`: as given; `room`: as light sees it (Room::scene). `cameras`, `views`: of the registration. `states`: how many
// there are. `free_places`: as in FurnitureOptions. `survey`: as in MovedWallsOptions.
RevisedRoom LookForFurniture(const Scene& mesh, const Scene& room, const RoomPhotos& photos,
                             const std::vector<Camera>& cameras, const std::vector<RegisteredView>& views,
                             int states, const std::vector<Eigen::Vector3d>& free_places,
                             const std::vector<SurveyedTag>& survey);

FurnitureChange ChangeOf(const RevisedRoom& revised);

// Returns the mesh with its walls moved, its pieces moved or left out, the boxes, and the parts of other paint.
Scene WithChange(Scene mesh, const FurnitureChange& change);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_ROOM_FURNITURE_H_
