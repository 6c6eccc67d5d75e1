// Illuminance by luminaires of neutral light in a room whose surfaces have colours.
//
//   E = E_direct + sum_c w_c E_indirect(rho_c) / sum_c w_c        over the channels R, G, B
//
// Light that is reflected takes the surfaces' colours on, so each channel has its own interreflection;
// channels of equal reflectances are solved once. Arrays as in forward/light/illuminance.h: lx per lm of luminaire.
//
// Throws std::invalid_argument for reflectances outside [0, 1), a number of columns that is not the number of
// materials, or weights that are negative or all zero.
#ifndef LUXFIT_FORWARD_LIGHT_COLOUR_ILLUMINANCE_H_
#define LUXFIT_FORWARD_LIGHT_COLOUR_ILLUMINANCE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/illuminance.h"
#include "forward/radiosity/solvers.h"

namespace luxfit {

struct ColourIlluminance {
  Eigen::MatrixXf total;             // receivers x luminaires, lx per lm
  Eigen::MatrixXf direct;            // its direct part
  Eigen::MatrixXf element_indirect;  // elements of the room x luminaires, lx per lm
  int solved_channels = 0;
  RadiositySolver solver = RadiositySolver::kAuto;  // the one used
  int iterations = 0;                               // of the slowest channel
  double error_percent = 0;  // bound of forward/radiosity/solvers.h; the worst channel's
};

// `albedo_rgb` is 3 x materials of the scene; `weights` those of R, G, B in luminance.
ColourIlluminance ComputeColourIlluminance(
    const Room& room, const Receivers& receivers, const LuminaireVisibility& visibility,
    const std::vector<Luminaire>& luminaires, const Eigen::Matrix3Xd& albedo_rgb,
    const Eigen::Vector3d& weights, const RadiositySolverOptions& solver = {RadiositySolver::kCholesky});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_COLOUR_ILLUMINANCE_H_
