#include "forward/factors/internal/directions.h"

namespace luxfit {

void DirectionCollector::Add(const Eigen::Vector3d& direction, double weight) {
  unit_.push_back(direction.normalized().cast<float>());
  weight_.push_back(static_cast<float>(weight));
}

Directions DirectionCollector::Get() const {
  const auto count = static_cast<Eigen::Index>(unit_.size());
  return {Eigen::Map<const Eigen::Matrix3Xf>(unit_.front().data(), 3, count),
          Eigen::Map<const Eigen::VectorXf>(weight_.data(), count)};
}

}  // namespace luxfit
