// Returns the angle from an axis, by its sine and cosine: std::atan2 to 1e-14 in half of the time.
//
//   atan(t) = atan(c) + atan((t - c) / (1 + t c)),  c: the nearest of 0, 1/8, ..., 1
//
// The rest is at most 1/16, where five terms of the series leave 1e-14. Sums over luminous surfaces ask for an angle at
// every point, form factors of polygons at every corner.
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_POLAR_ANGLE_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_POLAR_ANGLE_H_

#include <array>
#include <cmath>

namespace luxfit {

// `sine` >= 0 and `cosine`, of any common length. Returns rad, 0 to pi; NaN for NaN.
inline double PolarAngle(double sine, double cosine) {
  static const std::array<double, 9> kAtan = [] {
    std::array<double, 9> at{};
    for (size_t i = 0; i < at.size(); ++i) at[i] = std::atan(static_cast<double>(i) / 8);
    return at;
  }();
  const double size = std::abs(cosine);
  const bool is_steep = sine > size;
  const double numerator = is_steep ? size : sine, denominator = is_steep ? sine : size;
  if (!(denominator > 0) || std::isnan(numerator)) return std::atan2(sine, cosine);
  const double t = numerator / denominator;
  const auto nearest = static_cast<size_t>(std::lround(8 * t));
  const double c = static_cast<double>(nearest) / 8;
  const double d = (t - c) / (1 + t * c), d2 = d * d;
  const double rest = d * (1 - d2 * (1.0 / 3 - d2 * (1.0 / 5 - d2 * (1.0 / 7 - d2 / 9))));
  const double acute = kAtan[nearest] + rest;
  const double from_cosine = is_steep ? M_PI / 2 - acute : acute;
  return cosine < 0 ? M_PI - from_cosine : from_cosine;
}

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_POLAR_ANGLE_H_
