// Computes the direct light that a lobe gives from places where a luminaire may be.
//
//   D_il = V_i cos(theta_i) / d_i^2 I_l(gamma_i)
//
// D_il: illuminance per lumen at sensor i by lobe l. It is 0 at sensors that the mesh hides or that are nearer
// than 0.1 m. Rays are traced once for each place, for lobes of any aim. World frame; units m, lx, cd, lm.
// Source: forward/direct/direct_light.h.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LIT_PLACES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LIT_PLACES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/internal/search/lobes.h"
#include "inverse/model/internal/search/watched_places.h"

namespace luxfit {

struct LitPlace {
  Eigen::VectorXf lx_per_cd;                     // by sensor
  Eigen::Matrix<float, Eigen::Dynamic, 3> rays;  // unit vectors to the sensors
  std::vector<WatchingView> watching;
  Eigen::Vector3d half_length = Eigen::Vector3d::Zero();  // of a long luminaire, from its middle to an end
  std::vector<LitPlace> along;                            // its other points: they share its light evenly
};

struct LitPlaces {
  std::vector<Eigen::Vector3d> positions;
  std::vector<LitPlace> light;  // one for each position
};
// `views`: those that may watch the places.
LitPlaces Lit(const Room& room, const std::vector<Sensor>& sensors, std::vector<Eigen::Vector3d> positions,
              const std::vector<Watcher>& views = {});

// Returns the light from along a line: from five points in the middles of its fifths, or from the place alone where it has no length.
LitPlaces LitAlong(const Room& room, const std::vector<Sensor>& sensors, const Eigen::Vector3d& middle,
                   const Eigen::Vector3d& half_length);

// Returns D, sensors x lobes. A lobe to both sides of which the sensors see but one gives nothing. Throws std::invalid_argument for a lobe that is neither isotropic nor a cosine power.
Eigen::MatrixXf LobeColumns(const LitPlace& place, const std::vector<Lobe>& lobes);

// Returns the cell centres of a grid through the box, so that none lies on a wall.
std::vector<Eigen::Vector3d> GridThrough(const Eigen::AlignedBox3d& box, double step);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_LIT_PLACES_H_
