#include "forward/factors/internal/directions.h"

#include "forward/room/internal/sampling.h"

namespace luxfit {

void DirectionCollector::Add(const Eigen::Vector3d& direction, double weight) {
  unit_.push_back(direction.normalized().cast<float>());
  weight_.push_back(static_cast<float>(weight));
}

void DirectionCollector::AddLifted(double radius2, double turns, double weight) {
  Add(LiftedFromDisc(radius2, turns), weight);
}

Directions DirectionCollector::Get() const {
  Directions set;
  set.unit.resize(3, static_cast<Eigen::Index>(unit_.size()));
  set.weight.resize(static_cast<Eigen::Index>(unit_.size()));
  for (size_t k = 0; k < unit_.size(); ++k) {
    set.unit.col(static_cast<Eigen::Index>(k)) = unit_[k];
    set.weight[static_cast<Eigen::Index>(k)] = weight_[k];
  }
  return set;
}

}  // namespace luxfit
