// Photos of drawn boards with known truth: rays cast from the camera, the area of a pixel sampled, then
// blurred by a Gaussian and made noisy. Independent of calib's own image model.
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_BOARD_RENDER_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_BOARD_RENDER_H_

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/photo_files/image.h"
#include "calib/targets/board.h"
#include "tests/support/calib/blur.h"

namespace luxfit::support {

// Black or white of any place of a drawing; outside of its white margin, neither.
class Sheet {
 public:
  explicit Sheet(const BoardDrawing& drawing)
      : min_m_(drawing.min_m.array() - drawing.margin_m), max_m_(drawing.max_m.array() + drawing.margin_m) {
    for (const BlackRectangle& r : drawing.black) {
      for (const Eigen::Vector2d& p : {r.min_m, r.max_m}) {
        x_.push_back(p.x());
        y_.push_back(p.y());
      }
    }
    for (std::vector<double>* lines : {&x_, &y_}) {
      std::sort(lines->begin(), lines->end());
      // Ends that differ by rounding only are one line.
      lines->erase(std::unique(lines->begin(), lines->end(), [](double a, double b) { return b - a < 1e-9; }),
                   lines->end());
    }
    is_black_.assign((x_.size() + 1) * (y_.size() + 1), false);
    for (const BlackRectangle& r : drawing.black) {
      for (std::size_t row = Cell(y_, r.min_m.y() + 1e-9); row <= Cell(y_, r.max_m.y() - 1e-9); ++row) {
        for (std::size_t column = Cell(x_, r.min_m.x() + 1e-9); column <= Cell(x_, r.max_m.x() - 1e-9);
             ++column)
          is_black_[row * (x_.size() + 1) + column] = true;
      }
    }
  }

  bool Holds(const Eigen::Vector2d& place_m) const {
    return (place_m.array() >= min_m_.array()).all() && (place_m.array() <= max_m_.array()).all();
  }
  bool IsBlack(const Eigen::Vector2d& place_m) const {
    return is_black_[Cell(y_, place_m.y()) * (x_.size() + 1) + Cell(x_, place_m.x())];
  }

 private:
  static std::size_t Cell(const std::vector<double>& lines, double at) {
    return static_cast<std::size_t>(std::upper_bound(lines.begin(), lines.end(), at) - lines.begin());
  }

  std::vector<double> x_, y_;
  std::vector<bool> is_black_;
  Eigen::Vector2d min_m_, max_m_;
};

struct BoardRenderOptions {
  int samples_per_axis = 4;  // in each pixel
  double wall = 0.4, white = 0.85, black = 0.04;
  double exposure = 1;   // all of it times this, then clipped at 1
  double blur_px = 0.7;  // standard deviation
  double noise_sigma = 0;
  double levels = 0;  // quantised to 1 / levels; 0: not
  double gamma = 1;   // the exponent of the file: grey^(1 / gamma)
};

// Renders boards through one camera, whose rays it keeps.
class BoardRenderer {
 public:
  explicit BoardRenderer(const Camera& camera) : width_(camera.width_px), height_(camera.height_px) {
    // One ray more than pixels each way, at the pixels' corners: inside a pixel rays are linear to far better
    // than the sampling.
    rays_.reserve(static_cast<std::size_t>((width_ + 1) * (height_ + 1)));
    for (int v = 0; v <= height_; ++v) {
      for (int u = 0; u <= width_; ++u) rays_.push_back(Unproject(camera, Eigen::Vector2d(u - 0.5, v - 0.5)));
    }
  }

  ImagePlane Render(const Eigen::Isometry3d& cam_from_board, const BoardDrawing& drawing,
                    std::mt19937_64& rng, const BoardRenderOptions& options = {}) const {
    const Sheet sheet(drawing);
    const Eigen::Isometry3d board_from_cam = cam_from_board.inverse();
    ImagePlane plane(height_, width_);
    for (int v = 0; v < height_; ++v) {
      for (int u = 0; u < width_; ++u) {
        const std::array<Eigen::Vector2d, 4> corners_m = {
            Place(board_from_cam, u, v), Place(board_from_cam, u + 1, v), Place(board_from_cam, u, v + 1),
            Place(board_from_cam, u + 1, v + 1)};
        plane(v, u) = static_cast<float>(Grey(sheet, corners_m, options));
      }
    }
    return Developed(Blurred(plane, options.blur_px), rng, options);
  }

 private:
  // Where the ray through a corner of a pixel meets the board; NaN where it does not, or from behind.
  Eigen::Vector2d Place(const Eigen::Isometry3d& board_from_cam, int u, int v) const {
    const Eigen::Vector3d direction =
        board_from_cam.linear() * rays_[static_cast<std::size_t>(v * (width_ + 1) + u)];
    const Eigen::Vector3d start = board_from_cam.translation();
    const double depth = -start.z() / direction.z();
    if (!(depth > 0) || !(start.z() < 0)) return Eigen::Vector2d::Constant(std::nan(""));
    return (start + depth * direction).head<2>();
  }

  static double Grey(const Sheet& sheet, const std::array<Eigen::Vector2d, 4>& corners_m,
                     const BoardRenderOptions& options) {
    if (std::none_of(corners_m.begin(), corners_m.end(), [&](const auto& p) { return sheet.Holds(p); }))
      return options.wall;
    const int n = options.samples_per_axis;
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
      const double x = (i % n + 0.5) / n, y = (i / n + 0.5) / n;
      const Eigen::Vector2d place_m = (1 - y) * ((1 - x) * corners_m[0] + x * corners_m[1]) +
                                      y * ((1 - x) * corners_m[2] + x * corners_m[3]);
      double grey = options.wall;
      if (sheet.Holds(place_m)) grey = sheet.IsBlack(place_m) ? options.black : options.white;
      sum += grey;
    }
    return sum / (n * n);
  }

  static ImagePlane Developed(ImagePlane plane, std::mt19937_64& rng, const BoardRenderOptions& options) {
    std::normal_distribution<float> noise(0, 1);
    for (Eigen::Index i = 0; i < plane.size(); ++i) {
      float& grey = plane.data()[i];
      grey = grey * static_cast<float>(options.exposure);
      if (options.noise_sigma > 0) grey += static_cast<float>(options.noise_sigma) * noise(rng);
      grey = std::clamp(grey, 0.0f, 1.0f);
      if (options.gamma != 1) grey = std::pow(grey, static_cast<float>(1 / options.gamma));
      if (options.levels > 0)
        grey = std::round(grey * static_cast<float>(options.levels)) / static_cast<float>(options.levels);
    }
    return plane;
  }

  int width_ = 0, height_ = 0;
  std::vector<Eigen::Vector3d> rays_;
};

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_BOARD_RENDER_H_
