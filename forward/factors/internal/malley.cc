// Makes cosine-weighted rays by Malley's method: those of a low-discrepancy sequence, shifted
// (Cranley-Patterson), or one at random in each cell of a grid.
#include <algorithm>
#include <cmath>

#include "forward/factors/internal/directions.h"
#include "forward/factors/internal/methods.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

// Shifted copies of a sequence, one picked per receiver, which also turns it by an angle of its own.
constexpr int kMalleySets = 64;

Directions MalleyDirections(int count, uint64_t variant) {
  // Dimensions 3 and 4 of the recurrence are the origins (ray_rows.cc).
  const double shift = UnitFrom(Mix(variant));
  DirectionCollector set;
  for (int k = 1; k <= count; ++k) {
    set.Add(LiftedFromDisc(Fraction(shift + kGoldenSteps[0] * k), Fraction(kGoldenSteps[1] * k)),
            1.0 / count);
  }
  return set.Get();
}

Directions StratifiedDirections(int count, uint64_t variant) {
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(count))));
  uint64_t state = Mix(variant);
  DirectionCollector set;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double s = UnitFrom(state = Mix(state)), t = UnitFrom(state = Mix(state));
      set.Add(LiftedFromDisc((i + s) / side, (j + t) / side), 1.0 / (side * side));
    }
  }
  return set.Get();
}

}  // namespace

FormFactorOps MalleyMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kMalley;
  ops.name = "malley";
  ops.directions = MalleyDirections;
  ops.direction_sets = kMalleySets;
  return ops;
}

FormFactorOps MalleyStratifiedMethod() {
  FormFactorOps ops = MalleyMethod();
  ops.method = FormFactorMethod::kMalleyStratified;
  ops.name = "malley_stratified";
  ops.directions = StratifiedDirections;
  return ops;
}

}  // namespace luxfit
