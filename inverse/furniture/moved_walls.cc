#include "inverse/furniture/moved_walls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "forward/room/visibility.h"
#include "inverse/furniture/internal/hull_planes.h"
#include "inverse/furniture/internal/offset_sweep.h"
#include "inverse/furniture/internal/wall_offset.h"

namespace luxfit {
namespace {

constexpr size_t kFewestViewsOfRoom = 3, kMostMoves = 12;
constexpr double kTagFacesAlike = 0.99;                    // 8 degrees
constexpr double kTagOnPlaneM = 0.01, kTagAtWallM = 0.02;  // tags are glued on boards, too

bool HasMoved(const HullPlane& plane, const std::vector<MovedWall>& moved) {
  return std::any_of(moved.begin(), moved.end(), [&](const MovedWall& wall) {
    const PlaneMove& move = wall.move;
    return (move.normal - plane.normal).norm() < 1e-6 &&
           std::abs(move.offset_m + move.by_m - plane.offset_m) < kOnPlaneM;
  });
}

// Returns how far tags that face as the plane does lie before it, m.
std::vector<double> TagsBefore(const HullPlane& plane, const std::vector<SurveyedTag>& survey) {
  std::vector<double> before;
  for (const SurveyedTag& tag : survey)
    if (tag.normal_in_world.dot(plane.normal) > kTagFacesAlike)
      before.push_back(plane.normal.dot(tag.center_in_world) - plane.offset_m);
  return before;
}

std::optional<MovedWall> MovedWallOf(const Scene& mesh, const HullPlane& plane, const WallOffset& offset,
                                     const std::vector<SurveyedTag>& survey) {
  MovedWall wall{
      {plane.normal, plane.offset_m, offset.by_m}, offset.sigma_m, "", plane.area_m2, offset.views, 0};
  const int material = mesh.facets[static_cast<size_t>(plane.facets.front())].material;
  wall.material = mesh.materials[static_cast<size_t>(material)];
  for (const double before_m : TagsBefore(plane, survey)) {
    const double off_m = std::abs(before_m - offset.by_m);
    if (std::abs(before_m) < std::min(kTagOnPlaneM, off_m)) return std::nullopt;
    wall.tags += off_m < kTagAtWallM ? 1 : 0;
  }
  return wall;
}

// Returns the plane that gains most by moving.
std::optional<MovedWall> FindNext(const Scene& mesh, const std::vector<SignatureView>& views,
                                  const MovedWallsOptions& options, const std::vector<MovedWall>& moved) {
  const RayScene rays(mesh);
  const std::vector<HullPlane> planes = FindHullPlanes(mesh, rays);
  std::vector<std::optional<MovedWall>> walls(planes.size());
  std::vector<double> gain(planes.size(), 0);
  tbb::parallel_for(size_t{0}, planes.size(), [&](size_t i) {
    if (HasMoved(planes[i], moved)) return;
    const auto offset = EstimateOffset(planes[i], SweepOffsets(planes[i], rays, views, options.tolerance));
    if (!offset) return;
    walls[i] = MovedWallOf(mesh, planes[i], *offset, options.survey);
    if (walls[i]) gain[i] = offset->gain;
  });
  if (planes.empty()) return std::nullopt;
  return walls[static_cast<size_t>(std::max_element(gain.begin(), gain.end()) - gain.begin())];
}

}  // namespace

std::vector<MovedWall> FindMovedWalls(const Scene& mesh, const std::vector<SignatureView>& views,
                                      const MovedWallsOptions& options) {
  std::vector<MovedWall> moved;
  if (views.size() < kFewestViewsOfRoom || !mesh.surface.empty()) return moved;
  Scene room = mesh;
  while (moved.size() < kMostMoves) {
    const std::optional<MovedWall> wall = FindNext(room, views, options, moved);
    if (!wall) break;
    moved.push_back(*wall);
    room = WithPlanesMoved(std::move(room), {wall->move});
  }
  return moved;
}

}  // namespace luxfit
