#include "inverse/advise/candidates.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/room/in_room.h"
#include "inverse/advise/internal/photo_view.h"

namespace luxfit {
namespace {

// Returns points over the room at the height of the eye, in the open.
std::vector<Eigen::Vector3d> GridAtEyeHeight(const Room& room, double spacing_m) {
  std::vector<Eigen::Vector3d> grid;
  if (room.scene.facets.empty()) return grid;
  const Eigen::AlignedBox3d box = room.scene.Bounds();
  const Eigen::Vector3d size = box.sizes();
  const int nx = static_cast<int>(std::ceil(size.x() / spacing_m)),
            ny = static_cast<int>(std::ceil(size.y() / spacing_m));
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const Eigen::Vector3d p(box.min().x() + (i + 0.5) * size.x() / nx,
                              box.min().y() + (j + 0.5) * size.y() / ny, box.min().z() + kEyeHeightM);
      if (IsInRoom(room.rays, p)) grid.push_back(p);
    }
  }
  return grid;
}

bool HasFloorBelow(const Room& room, const Eigen::Vector3d& eye) {
  constexpr double kStepM = 0.1;
  const RayHit hit = room.rays.Trace(eye, -Eigen::Vector3d::UnitZ());
  return hit.facet >= 0 && hit.distance > kEyeHeightM - kStepM;
}

// Returns the sensor on the surface that a ray meets; its normal is zero where none is met from the front.
Sensor SensorOn(const Room& room, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  constexpr double kSensorThicknessM = 1e-3;
  const RayHit hit = room.rays.Trace(from, direction);
  if (hit.facet < 0 || !hit.front) return {from, Eigen::Vector3d::Zero(), {}};
  const Facet& facet = room.scene.facets[static_cast<size_t>(hit.facet)];
  const Eigen::Vector3d normal = facet.Normal();
  return {from + hit.distance * direction + kSensorThicknessM * normal, normal, {}};
}

void AddNew(const Sensor& sensor, std::vector<Sensor>& places) {
  if (sensor.normal.isZero()) return;
  const bool is_known = std::any_of(places.begin(), places.end(), [&](const Sensor& other) {
    return (other.position - sensor.position).norm() < 0.3 * kStandSpacingM;
  });
  if (!is_known) places.push_back(sensor);
}

}  // namespace

AdviceView ViewFrom(const std::string& id, const Eigen::Vector3d& eye, const Eigen::Vector3d& direction,
                    const Camera& camera) {
  if (!(direction.norm() > 0)) throw std::invalid_argument("ViewFrom: expected a direction of some length");
  const Eigen::Vector3d z = direction.normalized();
  // A camera that looks straight up or down has its picture's right along x.
  const Eigen::Vector3d across = z.cross(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d x = across.norm() > 1e-6 ? across.normalized() : Eigen::Vector3d::UnitX();
  Eigen::Isometry3d world_from_cam = Eigen::Isometry3d::Identity();
  world_from_cam.linear() << x, z.cross(x), z;
  world_from_cam.translation() = eye;
  return {id, world_from_cam.inverse(), camera};
}

std::vector<AdviceView> ViewsToTake(const Room& room, const Camera& camera,
                                    const std::vector<SurveyedTag>& tags, double spacing_m) {
  constexpr double kTiltsRad[] = {0, 0.35};
  std::vector<AdviceView> views;
  for (const Eigen::Vector3d& eye : GridAtEyeHeight(room, spacing_m)) {
    if (!HasFloorBelow(room, eye)) continue;
    for (int i = 0; i < kStandDirections; ++i) {
      const double heading = 2 * M_PI * i / kStandDirections;
      for (const double tilt : kTiltsRad) {
        const Eigen::Vector3d direction(std::cos(heading) * std::cos(tilt),
                                        std::sin(heading) * std::cos(tilt), std::sin(tilt));
        const AdviceView view = ViewFrom("", eye, direction, camera);
        if (tags.empty() ||
            VisibleTags(room, tags, camera, view.cam_from_world, kLeastTagSidePx) >= kFewestTags)
          views.push_back(view);
      }
    }
  }
  return views;
}

std::vector<Sensor> PlacesToRead(const Room& room, double spacing_m) {
  std::vector<Sensor> places;
  const std::vector<Eigen::Vector3d> grid = GridAtEyeHeight(room, spacing_m);
  for (const Eigen::Vector3d& eye : grid) {
    const Sensor below = SensorOn(room, eye, -Eigen::Vector3d::UnitZ());
    if (below.normal.z() > 0.9) AddNew(below, places);
  }
  for (const Eigen::Vector3d& eye : grid) {
    const Eigen::Vector3d from = eye - Eigen::Vector3d(0, 0, kEyeHeightM - kWallHeightM);
    if (!IsInRoom(room.rays, from)) continue;
    for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0),
                                             Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)})
      AddNew(SensorOn(room, from, direction), places);
  }
  return places;
}

std::string MaterialInView(const Room& room, const AdviceView& view) {
  const Eigen::Isometry3d world_from_cam = view.cam_from_world.inverse();
  const RayHit hit = room.rays.Trace(world_from_cam.translation(), world_from_cam.linear().col(2));
  if (hit.facet < 0) return "";
  const Facet& facet = room.scene.facets[static_cast<size_t>(hit.facet)];
  return room.scene.materials[static_cast<size_t>(facet.material)];
}

}  // namespace luxfit
