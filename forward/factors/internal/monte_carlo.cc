// Makes rays uniform over the hemisphere, weighted by 2 cos(theta).
#include <algorithm>
#include <cmath>

#include "forward/factors/internal/directions.h"
#include "forward/factors/internal/methods.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

Directions UniformDirections(int count, uint64_t variant) {
  uint64_t state = Mix(variant);
  DirectionCollector set;
  for (int k = 0; k < count; ++k) {
    const double cosine = UnitFrom(state = Mix(state)), angle = 2 * M_PI * UnitFrom(state = Mix(state));
    const double sine = std::sqrt(1 - cosine * cosine);
    set.Add({sine * std::cos(angle), sine * std::sin(angle), std::max(cosine, 1e-6)}, 2 * cosine / count);
  }
  return set.Get();
}

}  // namespace

FormFactorOps MonteCarloMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kMonteCarlo;
  ops.name = "montecarlo";
  ops.directions = UniformDirections;
  ops.direction_sets = 0;  // random afresh for every receiver
  return ops;
}

}  // namespace luxfit
