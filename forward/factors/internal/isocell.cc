// Makes cosine-weighted rays through the centres of equal cells of the disc.
#include "forward/factors/internal/directions.h"
#include "forward/factors/internal/methods.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

Directions IsocellDirections(int count, uint64_t) {
  const std::vector<Eigen::Vector2d> cells = Isocell(count);
  DirectionCollector set;
  for (const Eigen::Vector2d& cell : cells)
    set.Add(LiftedFromDisc(cell[0], cell[1]), 1.0 / static_cast<double>(cells.size()));
  return set.Get();
}

}  // namespace

FormFactorOps IsocellMethod() {
  FormFactorOps ops;
  ops.method = FormFactorMethod::kIsocell;
  ops.name = "isocell";
  ops.directions = IsocellDirections;
  return ops;
}

}  // namespace luxfit
