// Simulates observations of one wall of 40 x 30 elements by eight views that look straight at it, each from
// another place: what self-calibration needs, without a mesh or photos.
//
//   Y = truth * V(r) * (true exposure / stated) * (1 + 0.005 g)        g: standard normal
#ifndef LUXFIT_TESTS_SUPPORT_INVERSE_WALL_PHOTOS_H_
#define LUXFIT_TESTS_SUPPORT_INVERSE_WALL_PHOTOS_H_

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/vignetting.h"
#include "calib/register/registration.h"
#include "forward/room/patches.h"
#include "inverse/observe/observe.h"
#include "tests/support/calib/camera_model.h"

namespace luxfit::support {

struct WallPhotos {
  Camera camera;
  std::vector<RegisteredView> views;
  Patches patches;

  WallPhotos() {
    camera.width_px = 640;
    camera.height_px = 480;
    camera.fx_px = camera.fy_px = 400;
    camera.cx_px = 319.5;
    camera.cy_px = 239.5;
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        Element element;
        element.center = {0.1 * x, 0.1 * y, 0};
        element.normal = element.origin = element.edge_u = element.edge_v = Eigen::Vector3d::Zero();
        // Patches of 5 x 5.
        element.patch = y / 5 * 8 + x / 5;
        patches.elements.push_back(element);
      }
    }
    Patch patch;
    patch.center = patch.origin = patch.edge_u = patch.edge_v = Eigen::Vector3d::Zero();
    patches.patches.assign(48, patch);
    for (int view = 0; view < 8; ++view) {
      RegisteredView one;
      one.view = "v" + std::to_string(view);
      // Camera frame: the wall lies ahead.
      one.cam_from_world = Eigen::Translation3d(-0.4 - 0.45 * view, -0.5 - 0.25 * view, 2.0);
      views.push_back(one);
    }
  }

  double Truth(int element) const { return 0.2 + 0.1 * std::sin(0.3 * element); }

  // `exposure_factor`: by how much a view's photo was longer than stated.
  std::vector<Observation> Observe(bool vignetted, const std::vector<double>& exposure_factor,
                                   std::mt19937_64& rng) const {
    std::normal_distribution<double> noise(0, 0.005);
    const Vignetting frame = NoVignetting(camera.width_px, camera.height_px);
    std::vector<Observation> observations;
    for (int view = 0; view < 8; ++view) {
      for (int e = 0; e < static_cast<int>(patches.elements.size()); ++e) {
        const Eigen::Vector2d pixel = Project(camera, views[static_cast<size_t>(view)].cam_from_world *
                                                          patches.elements[static_cast<size_t>(e)].center);
        if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() > 639 || pixel.y() > 479) continue;
        double value = Truth(e);
        if (vignetted) value *= NaturalVignetting((pixel - frame.center_px).norm() / frame.radius_px, 0.7);
        value *= exposure_factor[static_cast<size_t>(view)] * (1 + noise(rng));
        observations.push_back({e, view, 0, 20, value, 1e-8, Eigen::Vector3d::Constant(value)});
      }
    }
    return observations;
  }
};

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_INVERSE_WALL_PHOTOS_H_
