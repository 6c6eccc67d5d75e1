// A camera as a closed formula: luminance -> counts. Truth for tests of linearising and merging, which know
// nothing of it.
//
//   x = luminance * exposure * V(r),   electrons ~ Poisson(full_well * x) + Normal(0, read),
//   count = clamp(round((full_scale - black) * R(electrons / full_well) + black))
#ifndef LUXFIT_TESTS_SUPPORT_CALIB_CAMERA_MODEL_H_
#define LUXFIT_TESTS_SUPPORT_CALIB_CAMERA_MODEL_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "calib/photo_files/image.h"

namespace luxfit::support {

struct CameraModel {
  std::function<double(double)> response;  // share of full scale, 0..1 -> 0..1; none: linear
  int bits = 16;
  double full_scale_counts = 65535;
  double black_counts = 0;
  double full_well = 20000;  // electrons; 0: no noise at all
  double read_electrons = 4;
};

// IEC 61966-2-1, the encoding of 8-bit pictures.
inline double SrgbEncoded(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}
inline double SrgbDecoded(double y) { return y <= 0.04045 ? y / 12.92 : std::pow((y + 0.055) / 1.055, 2.4); }

// A film's characteristic curve between toe and shoulder: logistic in log exposure, 1 at x = 1.
inline double FilmEncoded(double x) {
  constexpr double kHalf = 0.12, kGamma = 1.15;
  const double p = std::pow(std::max(x, 0.0) / kHalf, kGamma), one = std::pow(1 / kHalf, kGamma);
  return p / (1 + p) * (1 + one) / one;
}

// cos^4 of the field angle times a mechanical loss: r = 1 at the corner, whose field angle is given.
inline double NaturalVignetting(double r, double corner_angle_rad) {
  const double tangent = r * std::tan(corner_angle_rad);
  return std::pow(1 + tangent * tangent, -2) * (1 - 0.05 * std::pow(r, 6));
}

// `luminance`: red, green and blue, such that luminance * exposure = 1 is full scale.
template <typename Rng>
Photo Shoot(const CameraModel& camera, const std::array<ImagePlane, 3>& luminance, double exposure,
            Rng& rng) {
  Photo photo;
  photo.bits_per_channel = camera.bits;
  photo.full_scale_counts = photo.saturation_counts = camera.full_scale_counts;
  std::normal_distribution<double> read(0, camera.read_electrons > 0 ? camera.read_electrons : 1);
  for (size_t c = 0; c < 3; ++c) {
    photo.rgb_counts[c] = luminance[c].unaryExpr([&](float l) {
      double x = l * exposure;
      if (camera.full_well > 0) {
        double electrons = static_cast<double>(std::poisson_distribution<long>(camera.full_well * x)(rng));
        if (camera.read_electrons > 0) electrons += read(rng);
        x = electrons / camera.full_well;
      }
      const double y = camera.response ? camera.response(std::clamp(x, 0.0, 1.0)) : x;
      const double count =
          std::round((camera.full_scale_counts - camera.black_counts) * y + camera.black_counts);
      return static_cast<float>(std::clamp(count, 0.0, camera.full_scale_counts));
    });
  }
  return photo;
}

// A ramp of luminance, equal steps in its logarithm along each row, from `low` to `high`.
inline std::array<ImagePlane, 3> LogRamp(int height, int width, double low, double high) {
  ImagePlane ramp(height, width);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u)
      ramp(v, u) = static_cast<float>(low * std::pow(high / low, u / double(std::max(1, width - 1))));
  }
  return {ramp, ramp, ramp};
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_CALIB_CAMERA_MODEL_H_
