#include "inverse/observe/room_furniture.h"

#include <utility>

#include "inverse/furniture/photo_gains.h"
#include "inverse/observe/room_signatures.h"

namespace luxfit {

RevisedRoom LookForFurniture(const Scene& mesh, const Scene& room, const RoomPhotos& photos,
                             const std::vector<Camera>& cameras, const std::vector<RegisteredView>& views,
                             int states, const std::vector<Eigen::Vector3d>& free_places,
                             const std::vector<SurveyedTag>& survey) {
  if (views.size() < 3) return {};
  std::vector<SignatureView> signatures = SignaturesOf(photos, cameras, views, states);
  MovedWallsOptions of_walls;
  of_walls.survey = survey;
  FurnitureOptions options;
  options.free_places = free_places;
  RevisedRoom revised;
  revised.mesh_as_if = FindMeshAsIf(mesh, signatures, survey);
  if (!revised.mesh_as_if.empty()) return revised;  // all of it would be furniture that the room lacks
  const PhotoGains gains = EstimatePhotoGains(mesh, signatures, options.tolerance);
  signatures = WithoutGains(std::move(signatures), gains);
  revised.walls = FindMovedWalls(mesh, signatures, of_walls);
  if (revised.walls.empty()) {
    revised.furniture = ReviseFurniture(mesh, room, signatures, options);
  } else {
    const Scene standing = WithPlanesMoved(mesh, ChangeOf(revised).walls);
    revised.furniture = ReviseFurniture(standing, standing, signatures, options);
  }
  revised.parts = FindPaintedParts(WithChange(mesh, ChangeOf(revised)), signatures);
  return revised;
}

FurnitureChange ChangeOf(const RevisedRoom& revised) {
  FurnitureChange change;
  for (const FoundBox& found : revised.furniture.found) change.boxes.push_back(found.box);
  for (const MissingPiece& piece : revised.furniture.missing) change.moves.push_back(piece.move);
  for (const MovedWall& wall : revised.walls) change.walls.push_back(wall.move);
  for (const PaintedPart& part : revised.parts) change.parts.push_back(part.rectangle);
  return change;
}

Scene WithChange(Scene mesh, const FurnitureChange& change) {
  Scene standing = WithPiecesMoved(WithPlanesMoved(std::move(mesh), change.walls), change.moves);
  return WithPaintedRectangles(WithBoxes(std::move(standing), change.boxes), change.parts);
}

}  // namespace luxfit
