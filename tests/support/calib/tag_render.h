// The one picture of tags with known truth: every sample ray is cast from the camera, so distortion,
// perspective and the area of a pixel are exact up to the number of samples. Independent of calib's own image
// model.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_TAG_RENDER_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_TAG_RENDER_H_

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/photo_files/image.h"
#include "calib/targets/tags.h"

namespace luxfit::support {

// Tag 0 of family tag36h11 as AprilTag's own tag36_11_00000.png shows it: 10 x 10 cells, white rim included;
// 1 is white. Inside its black border the six rows of six bits are code 0xd5d628584 of the AprilTag 2 tables,
// highest bit first.
inline constexpr const char* kTag36h11Id0[10] = {"1111111111", "1000000001", "1011010101", "1001110101",
                                                 "1001100001", "1010100001", "1001011001", "1000010001",
                                                 "1000000001", "1111111111"};

struct TagRenderOptions {
  int samples_per_axis = 8;  // in each pixel
  double wall = 0.5;         // grey of everything that is not a tag
  double white = 0.85;
  double black = 0.04;
  double shading_across = 0.0;  // grey falls by this fraction from the left of the picture to its right
  double noise_sigma = 0.0;
};

// Tags (all drawn with the picture of id 0) seen by a camera; height x width.
inline ImagePlane RenderTags(const Camera& camera, const Eigen::Isometry3d& cam_from_world,
                             const std::vector<SurveyedTag>& tags, std::mt19937_64& rng,
                             const TagRenderOptions& options = {}) {
  struct Placed {
    Eigen::Vector3d origin, right, down, normal;  // in the camera frame; right and down one cell long
  };
  std::vector<Placed> placed;
  for (const SurveyedTag& tag : tags) {
    const double cell_m = tag.size_m / 8;
    const Eigen::Matrix3d r = cam_from_world.linear();
    Placed p;
    p.right = cell_m * (r * tag.up_in_world.cross(tag.normal_in_world));
    p.down = -cell_m * (r * tag.up_in_world);
    p.normal = r * tag.normal_in_world;
    p.origin = cam_from_world * tag.center_in_world - 5 * p.right - 5 * p.down;
    placed.push_back(p);
  }
  // Cell (column, row) of the tag that the ray meets; far outside if it meets none.
  const auto cell_of = [](const Placed& p, const Eigen::Vector3d& ray) {
    const double depth = p.normal.dot(p.origin) / p.normal.dot(ray);
    if (!(depth > 0) || !(p.normal.dot(ray) < 0)) return Eigen::Vector2d(-1e9, -1e9);
    const Eigen::Vector3d at = depth * ray - p.origin;
    return Eigen::Vector2d(at.dot(p.right) / p.right.squaredNorm(), at.dot(p.down) / p.down.squaredNorm());
  };
  const auto grey_along = [&](const Eigen::Vector3d& ray) {
    double grey = options.wall;
    for (const Placed& p : placed) {
      const Eigen::Vector2d cell = cell_of(p, ray).array().floor();
      if (cell.minCoeff() < 0 || cell.maxCoeff() > 9) continue;
      const char picture = kTag36h11Id0[static_cast<int>(cell.y())][static_cast<int>(cell.x())];
      grey = picture == '1' ? options.white : options.black;
    }
    return grey;
  };
  std::normal_distribution<double> noise(0, 1);
  ImagePlane plane(camera.height_px, camera.width_px);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector3d middle = Unproject(camera, Eigen::Vector2d(u, v));
      // A pixel is less than two cells wide: further from every tag, one ray tells all.
      const bool near_tag = std::any_of(placed.begin(), placed.end(), [&](const Placed& p) {
        const Eigen::Vector2d cell = cell_of(p, middle);
        return cell.minCoeff() > -2 && cell.maxCoeff() < 12;
      });
      double grey = options.wall;
      if (near_tag) {
        const int n = options.samples_per_axis;
        double sum = 0;
        for (int i = 0; i < n * n; ++i) {
          const Eigen::Vector2d pixel(u - 0.5 + (i % n + 0.5) / n, v - 0.5 + (i / n + 0.5) / n);
          sum += grey_along(Unproject(camera, pixel));
        }
        grey = sum / (n * n);
      }
      const double shade = 1 - options.shading_across * u / camera.width_px;
      plane(v, u) = static_cast<float>(grey * shade + options.noise_sigma * noise(rng));
    }
  }
  return plane;
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_TAG_RENDER_H_
