// Computes the direct light that lobes of several widths and aims give from places where a luminaire may be.
//
// Columns hold D_il, the illuminance per lumen at sensor i by lobe l. It is 0 at sensors that the mesh hides
// or that are nearer than 0.1 m. World frame; units m, lx/lm.
// Source: forward/direct/direct_light.h.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LIT_PLACES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LIT_PLACES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "forward/light/room.h"

namespace luxfit {

struct Lobe {
  Distribution distribution;
  double exponent;
  Eigen::Vector3d aim;
};
// Returns the lobes that are tried.
const std::vector<Lobe>& Lobes();

struct LitPlaces {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::MatrixXf> columns;  // one matrix per position: sensors x lobes
};
LitPlaces Lit(const Room& room, const std::vector<Sensor>& sensors, std::vector<Eigen::Vector3d> positions);

// Returns the cell centres of a grid through the box, so that none lies on a wall.
std::vector<Eigen::Vector3d> GridThrough(const Eigen::AlignedBox3d& box, double step);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LIT_PLACES_H_
