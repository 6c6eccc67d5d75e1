#include "apps/stages/register/lay_on_mesh.h"

#include <optional>
#include <stdexcept>

#include "apps/stages/stages.h"
#include "calib/register/mesh_alignment.h"
#include "inverse/observe/scene_surface.h"

namespace luxfit {
namespace {

Similarity StartOf(const Session& session, const std::vector<FeatureView>& views,
                   std::optional<double> scale) {
  const std::optional<Similarity> start =
      StartFromPlaces(views, session.registration.start_positions_m, scale);
  if (start) return *start;
  throw std::runtime_error(
      session.path +
      ": registration.start: expected the rough places of three registered views or more that "
      "are not on one line, got fewer; add views to start = { v00 = [x, y, z], ... }");
}

void ExpectStartAndMesh(const Session& session) {
  if (session.registration.start_positions_m.empty())
    throw std::runtime_error(
        session.path +
        ": registration.start: expected where three cameras or more roughly stood, since no "
        "tag map tells the scene's frame, got nothing; add [registration] start = { v00 = [x, y, "
        "z], ... }");
  if (!session.scene)
    throw std::runtime_error(
        session.path +
        ": scene.mesh: expected a room to lay the photos' points onto, got none; add [scene] "
        "with mesh, size or outline");
}

Registration NotLaid(const SurfaceAlignment& alignment) {
  Registration registration;
  registration.message = "the photos cannot be laid onto the mesh: " + alignment.message;
  return registration;
}

}  // namespace

Registration RegisterOnMesh(const Session& session, const std::vector<Camera>& cameras,
                            const std::vector<ViewDetections>& views, const FeatureModel& features) {
  ExpectStartAndMesh(session);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(features.tracks.size()));
  for (size_t i = 0; i < features.tracks.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = features.tracks[i].p_in_model;
  const SurfaceAlignment alignment = AlignPointsToSurface(points, SurfaceOf(LoadMesh(session).scene),
                                                          StartOf(session, features.views, std::nullopt));
  if (!alignment.is_determined) return NotLaid(alignment);
  return RegisterViews(cameras, {}, views, OnSurface(features, alignment));
}

Registration LaidOnMesh(const Session& session, const Registration& registration) {
  ExpectStartAndMesh(session);
  Eigen::Matrix3Xd corners(3, static_cast<Eigen::Index>(4 * registration.placed_tags.size()));
  Eigen::Index column = 0;
  for (const SurveyedTag& tag : registration.placed_tags) {
    for (const Eigen::Vector3d& corner : TagCornersInWorld(tag)) corners.col(column++) = corner;
  }
  std::vector<FeatureView> views;
  views.reserve(registration.views.size());
  for (const RegisteredView& view : registration.views) views.push_back({view.view, view.cam_from_world});
  SurfaceAlignmentOptions options;
  options.scale_is_free = false;
  const SurfaceAlignment alignment = AlignPointsToSurface(corners, SurfaceOf(LoadMesh(session).scene),
                                                          StartOf(session, views, 1.0), options);
  return alignment.is_determined ? MovedToSurface(registration, alignment) : NotLaid(alignment);
}

}  // namespace luxfit
