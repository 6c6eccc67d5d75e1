// Collects a set of directions over a hemisphere, one by one.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_DIRECTIONS_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_DIRECTIONS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/factors/form_factors.h"

namespace luxfit {

class DirectionCollector {
 public:
  // A direction of any length.
  void Add(const Eigen::Vector3d& direction, double weight);
  // Returns the set; there must be a direction in it.
  Directions Get() const;

 private:
  std::vector<Eigen::Vector3f> unit_;
  std::vector<float> weight_;
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_DIRECTIONS_H_
