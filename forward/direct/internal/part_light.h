// Returns the light of every part of a luminaire alone, all parts in one pass over its surface.
//
// The parts are those of forward/luminaire/luminaire_parts.h. The work is that of the light of the whole.
// Results are lx per lm of each part alone; the surface points are those that the whole is summed over.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_PART_LIGHT_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_PART_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/direct/sensor.h"
#include "forward/luminaire/luminaire_parts.h"

namespace luxfit {

class PartLight {
 public:
  // Throws std::invalid_argument where the luminaire has no such parts.
  PartLight(const Luminaire& luminaire, PartKind kind);

  Eigen::Index size() const { return size_; }
  Eigen::VectorXd At(const Sensor& place) const;

 private:
  void AddNodes(const Luminaire& cell, const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                Eigen::VectorXd& sum) const;

  Luminaire whole_;
  PartKind kind_;
  Eigen::Index size_;             // number of parts
  std::vector<Luminaire> cells_;  // kCell: each with 1 lm; else each with its share as flux
  Eigen::VectorXd node_flux_;
  Eigen::MatrixXd nodes_of_sides_;  // kSide only
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_PART_LIGHT_H_
