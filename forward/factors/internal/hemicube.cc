// Makes rays through the pixels of half a cube over the receiver's centre, with their delta form factors.
#include <algorithm>
#include <cmath>

#include "forward/factors/internal/directions.h"
#include "forward/factors/internal/methods.h"

namespace luxfit {
namespace {

Directions HemicubeDirections(int count, uint64_t) {
  // Half-width and height 1, `side` x `side` pixels on top and half as many on each side: 3 side^2 in all.
  const int half = std::max(1, static_cast<int>(std::lround(std::sqrt(count / 12.0))));
  const double width = 1.0 / half, area = width * width;
  DirectionCollector set;
  for (int i = -half; i < half; ++i) {
    const double x = (i + 0.5) * width;
    for (int j = -half; j < half; ++j) {
      const double y = (j + 0.5) * width, r2 = x * x + y * y + 1;
      set.Add({x, y, 1}, area / (M_PI * r2 * r2));
    }
    for (int j = 0; j < half; ++j) {
      const double z = (j + 0.5) * width, r2 = x * x + z * z + 1, delta = z * area / (M_PI * r2 * r2);
      set.Add({x, 1, z}, delta);
      set.Add({x, -1, z}, delta);
      set.Add({1, x, z}, delta);
      set.Add({-1, x, z}, delta);
    }
  }
  return set.Get();
}

}  // namespace

FormFactorOps HemicubeMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kHemicube;
  ops.name = "hemicube";
  ops.is_from_center = true;
  ops.directions = HemicubeDirections;
  return ops;
}

}  // namespace luxfit
