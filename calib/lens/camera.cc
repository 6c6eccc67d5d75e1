#include "calib/lens/camera.h"

#include "calib/lens/internal/lens.h"

namespace luxfit {

Projection ProjectWithJacobian(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  const LensImage image = OpsOf(camera.lens).image(camera, p_in_cam);
  const Eigen::Vector2d focal_px(camera.fx_px, camera.fy_px);
  return {focal_px.cwiseProduct(image.xy) + Eigen::Vector2d(camera.cx_px, camera.cy_px),
          focal_px.asDiagonal() * image.d_point};
}

Camera WithFocalScale(Camera camera, double scale) {
  camera.fx_px *= scale;
  camera.fy_px *= scale;
  return camera;
}

Eigen::Vector2d Project(const Camera& camera, const Eigen::Vector3d& p_in_cam) {
  return ProjectWithJacobian(camera, p_in_cam).pixel;
}

Eigen::Vector3d Unproject(const Camera& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d xy((pixel.x() - camera.cx_px) / camera.fx_px,
                           (pixel.y() - camera.cy_px) / camera.fy_px);
  if (!xy.allFinite()) return Eigen::Vector3d::Constant(kNoImage);
  return OpsOf(camera.lens).direction(camera, xy).normalized();
}

}  // namespace luxfit
