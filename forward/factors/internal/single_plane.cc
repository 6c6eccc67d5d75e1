// Makes rays through the proxels of one plane over the receiver's centre; the horizon is left out.
#include <algorithm>
#include <cmath>

#include "forward/factors/internal/directions.h"
#include "forward/factors/internal/methods.h"

namespace luxfit {
namespace {

// Configuration factor to a parallel rectangle with a corner overhead (Howell's catalogue, B-3), at distance
// 1; odd in both.
double CornerFactor(double a, double b) {
  const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * M_PI);
}

Directions ProxelDirections(int count, uint64_t) {
  // Proxels wider towards the rim, where they count less: their borders are at equal steps of a / sqrt(1 +
  // a^2).
  constexpr double kHalfWidth = 10;
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(count))));
  const double reach = kHalfWidth / std::sqrt(1 + kHalfWidth * kHalfWidth);
  const auto border = [&](double i) {
    const double s = reach * (2.0 * i / side - 1);
    return s / std::sqrt(1 - s * s);
  };
  DirectionCollector set;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double x0 = border(i), x1 = border(i + 1), y0 = border(j), y1 = border(j + 1);
      const double factor =
          CornerFactor(x1, y1) - CornerFactor(x0, y1) - CornerFactor(x1, y0) + CornerFactor(x0, y0);
      set.Add({border(i + 0.5), border(j + 0.5), 1}, factor);
    }
  }
  return set.Get();
}

}  // namespace

FormFactorOps SinglePlaneMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kSinglePlane;
  ops.name = "single_plane";
  ops.is_from_center = true;
  ops.directions = ProxelDirections;
  return ops;
}

}  // namespace luxfit
