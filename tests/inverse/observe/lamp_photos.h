// Photos of a room with luminous rectangles below its ceiling, a glossy table and a surface of its own
// brightness: every pixel's ray met with planes, no rasteriser and no mesh.
//
//   Y of a pixel = that of the lamp it meets first, else 0.7 of the lamp's that its mirror ray meets (the
//   table is a mirror), else that of the patch, else 1
//
// Clipped and rounded to 16 bits at the photo's exposure.
#ifndef LUXFIT_TESTS_INVERSE_OBSERVE_LAMP_PHOTOS_H_
#define LUXFIT_TESTS_INVERSE_OBSERVE_LAMP_PHOTOS_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"
#include "inverse/observe/observe.h"

namespace luxfit::support {

// Horizontal.
struct LuminousRectangle {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector2d half_size_m{0.3, 0.3};
  double luminance = 100;  // of a lamp: that of the room's surfaces is 1
};

struct LampScene {
  std::vector<LuminousRectangle> lamps;
  std::vector<LuminousRectangle> mirrors;  // their luminance does not count
  std::vector<LuminousRectangle> patches;  // lit surfaces
};

// Distance along the ray to the rectangle; none where it misses.
inline std::optional<double> Meets(const LuminousRectangle& r, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  const double distance = (r.center.z() - origin.z()) / direction.z();
  const Eigen::Vector3d p = origin + distance * direction - r.center;
  const bool hit =
      distance > 0 && std::abs(p.x()) <= r.half_size_m.x() && std::abs(p.y()) <= r.half_size_m.y();
  return hit ? std::optional(distance) : std::nullopt;
}

inline double LuminanceAlong(const LampScene& scene, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction) {
  for (const LuminousRectangle& lamp : scene.lamps) {
    if (Meets(lamp, origin, direction)) return lamp.luminance;
  }
  for (const LuminousRectangle& mirror : scene.mirrors) {
    const std::optional<double> distance = Meets(mirror, origin, direction);
    if (!distance) continue;
    const Eigen::Vector3d mirrored(direction.x(), direction.y(), -direction.z());
    for (const LuminousRectangle& lamp : scene.lamps) {
      if (Meets(lamp, origin + *distance * direction, mirrored)) return 0.7 * lamp.luminance;
    }
  }
  for (const LuminousRectangle& patch : scene.patches) {
    if (Meets(patch, origin, direction)) return patch.luminance;
  }
  return 1;
}

// An exposure of 1 saturates at a luminance of 1. `directions`: of the camera's pixels.
inline Photo PhotographLamps(const LampScene& scene, const Camera& camera, const PixelDirections& directions,
                             const Eigen::Isometry3d& cam_from_world, double exposure_s) {
  Photo photo;
  for (ImagePlane& plane : photo.rgb_counts) plane.resize(camera.height_px, camera.width_px);
  const Eigen::Isometry3d world_from_cam = cam_from_world.inverse();
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    const Eigen::Vector3d direction = world_from_cam.linear() * directions.col(i).cast<double>();
    const double relative = exposure_s * LuminanceAlong(scene, world_from_cam.translation(), direction);
    for (ImagePlane& plane : photo.rgb_counts)
      plane.data()[i] = static_cast<float>(std::round(65535 * std::min(1.0, relative)));
  }
  return photo;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_INVERSE_OBSERVE_LAMP_PHOTOS_H_
