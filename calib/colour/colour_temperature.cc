#include "calib/colour/colour_temperature.h"

#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

constexpr double kLeastMired = 1e6 / 15000, kMostMired = 1e6 / 1000, kFarthest = 0.05;

Eigen::Vector2d LocusAt(double mired) {
  const double t = 1e6 / mired;
  return {
      (0.860117757 + t * (1.54118254e-4 + t * 1.28641212e-7)) / (1 + t * (8.42420235e-4 + t * 7.08145163e-7)),
      (0.317398726 + t * (4.22806245e-5 + t * 4.20481691e-8)) /
          (1 + t * (-2.89741816e-5 + t * 1.61456053e-7))};
}

Eigen::Vector2d UvOf(const Eigen::Vector3d& xyz) {
  return Eigen::Vector2d(4 * xyz.x(), 6 * xyz.y()) / (xyz.x() + 15 * xyz.y() + 3 * xyz.z());
}

// Holds the reciprocal temperature, 1e6 / K, in which the locus runs evenly, and duv.
struct Place {
  double mired = 0, duv = 0;
};

Place NearestOf(const Eigen::Vector2d& uv) {
  const auto distance = [&](double mired) { return (uv - LocusAt(mired)).norm(); };
  // The distance has one minimum within some 0.1 of the locus: golden section.
  constexpr double kGolden = 0.6180339887498949, kEnough = 1e-6;
  double low = kLeastMired, high = kMostMired;
  while (high - low > kEnough) {
    const double step = kGolden * (high - low);
    if (distance(high - step) < distance(low + step)) {
      high = low + step;
    } else {
      low = high - step;
    }
  }
  const double mired = (low + high) / 2;
  return {mired, std::copysign(distance(mired), uv.y() - LocusAt(mired).y())};
}

Place PlaceOf(const Eigen::Vector3d& xyz) { return NearestOf(UvOf(xyz)); }

}  // namespace

std::optional<ColourTemperature> ColourTemperatureOf(const Eigen::Vector3d& xyz,
                                                     const Eigen::Matrix3d& covariance) {
  if (!xyz.allFinite() || !(xyz.y() > 0) || !(xyz.sum() > 0)) return std::nullopt;
  const Place place = PlaceOf(xyz);
  constexpr double kOffEnd = 1e-3;
  const bool is_off_end = place.mired < kLeastMired + kOffEnd || place.mired > kMostMired - kOffEnd;
  if (is_off_end || std::abs(place.duv) > kFarthest) return std::nullopt;
  constexpr double kStep = 1e-4;
  Eigen::Vector3d mired_slope, duv_slope;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3d more = xyz, less = xyz;
    more[i] *= 1 + kStep;
    less[i] *= 1 - kStep;
    const Place above = PlaceOf(more), below = PlaceOf(less);
    mired_slope[i] = (above.mired - below.mired) / (2 * kStep);
    duv_slope[i] = (above.duv - below.duv) / (2 * kStep);
  }
  ColourTemperature found;
  found.kelvin = 1e6 / place.mired;
  found.kelvin_sigma = found.kelvin / place.mired * std::sqrt(mired_slope.dot(covariance * mired_slope));
  found.duv = place.duv;
  found.duv_sigma = std::sqrt(duv_slope.dot(covariance * duv_slope));
  found.xy = xyz.head<2>() / xyz.sum();
  return found;
}

}  // namespace luxfit
