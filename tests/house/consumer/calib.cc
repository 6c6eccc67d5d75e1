// A camera without distortion sees (1, 0, 2) m at cx + fx / 2, and its pixel looks back along that ray; a
// file that is not there is refused.
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "calib/lens/camera.h"
#include "calib/lens/camera_file.h"

int main() {
  luxfit::Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 500;
  camera.cx_px = 320;
  camera.cy_px = 240;
  const Eigen::Vector2d pixel = luxfit::Project(camera, {1, 0, 2});
  const Eigen::Vector3d ray = luxfit::Unproject(camera, pixel);
  bool refuses = false;
  try {
    luxfit::ReadCameraFile("none.yaml");
  } catch (const std::runtime_error&) {
    refuses = true;
  }
  std::printf("calib: %.1f %.1f px\n", pixel.x(), pixel.y());
  return pixel.isApprox(Eigen::Vector2d(570, 240)) && std::abs(ray.x() / ray.z() - 0.5) < 1e-9 && refuses ? 0
                                                                                                          : 1;
}
