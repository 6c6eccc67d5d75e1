#include "inverse/observe/watchers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

constexpr int kRaysASide = 6;

// Returns pixels along the border, clockwise in the picture.
std::vector<Eigen::Vector2d> BorderPixels(const Camera& camera) {
  const double right = camera.width_px - 1, bottom = camera.height_px - 1;
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  std::vector<Eigen::Vector2d> pixels;
  for (size_t c = 0; c < corners.size(); ++c)
    for (int i = 0; i < kRaysASide; ++i)
      pixels.emplace_back(corners[c] + (corners[(c + 1) % corners.size()] - corners[c]) * i / kRaysASide);
  return pixels;
}

Watcher ViewOf(const Camera& camera, const RegisteredView& view) {
  Watcher shown;
  shown.eye = view.cam_from_world.inverse().translation();
  const Eigen::Matrix3d world_from_cam = view.cam_from_world.linear().transpose();
  for (const Eigen::Vector2d& pixel : BorderPixels(camera))
    shown.border.push_back((world_from_cam * Unproject(camera, pixel)).normalized());
  return shown;
}

}  // namespace

std::vector<Watcher> WatchersOf(const std::vector<Camera>& cameras, const std::vector<RegisteredView>& views,
                                const std::vector<PhotoBlobs>& photos) {
  std::vector<Watcher> shown;
  shown.reserve(views.size());
  for (const RegisteredView& view : views)
    shown.push_back(ViewOf(cameras[static_cast<size_t>(view.camera)], view));
  for (const PhotoBlobs& photo : photos) shown[static_cast<size_t>(photo.view)].states.push_back(photo.state);
  return shown;
}

bool IsInPicture(const Watcher& view, const Eigen::Vector3d& direction) {
  for (size_t i = 0; i < view.border.size(); ++i) {
    const Eigen::Vector3d& a = view.border[i];
    const Eigen::Vector3d& b = view.border[(i + 1) % view.border.size()];
    if (!(a.cross(b).dot(direction) > 0)) return false;
  }
  return true;
}

}  // namespace luxfit
