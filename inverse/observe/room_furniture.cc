#include "inverse/observe/room_furniture.h"

#include <tbb/parallel_for.h>

#include <memory>
#include <utility>

namespace luxfit {
namespace {

std::vector<SignatureView> SignaturesOf(const RoomPhotos& photos, const std::vector<Camera>& cameras,
                                        const std::vector<RegisteredView>& views, int states) {
  std::vector<SignatureView> signatures(views.size());
  tbb::parallel_for(size_t{0}, views.size(), [&](size_t v) {
    std::vector<std::shared_ptr<const LuminanceImage>> kept(static_cast<size_t>(states));
    std::vector<const LuminanceImage*> images(kept.size());
    for (size_t i = 0; i < photos.photos.size(); ++i) {
      const RoomPhoto& photo = photos.photos[i];
      if (photo.view != views[v].view || photo.camera != views[v].camera) continue;
      const auto state = static_cast<size_t>(photo.state);
      kept[state] = photos.read(i);
      images[state] = kept[state].get();
    }
    signatures[v] =
        MakeSignatureView(cameras[static_cast<size_t>(views[v].camera)], views[v].cam_from_world, images);
    signatures[v].pose_covariance = views[v].covariance;
  });
  return signatures;
}

}  // namespace

RevisedRoom LookForFurniture(const Scene& mesh, const Scene& room, const RoomPhotos& photos,
                             const std::vector<Camera>& cameras, const std::vector<RegisteredView>& views,
                             int states, const std::vector<Eigen::Vector3d>& free_places,
                             const std::vector<SurveyedTag>& survey) {
  if (views.size() < 3) return {};
  const std::vector<SignatureView> signatures = SignaturesOf(photos, cameras, views, states);
  MovedWallsOptions of_walls;
  of_walls.survey = survey;
  FurnitureOptions options;
  options.free_places = free_places;
  RevisedRoom revised;
  revised.mesh_as_if = FindMeshAsIf(mesh, signatures, survey);
  if (!revised.mesh_as_if.empty()) return revised;  // all of it would be furniture that the room lacks
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
