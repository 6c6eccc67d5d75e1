// Computes illuminance and luminous exitance of every patch of a room, by luminaire.
//
//   E_jk = mean over the elements of j of (direct + interreflected illuminance) of luminaire k      lx
//   M_jk = sum_c w_c rho_jc E_jkc / sum_c w_c                                                       lm/m2
//
// The sums run over the channels c = R, G, B, each with its own interreflection. A patch's luminance is M /
// pi. Fluxes are the luminaires' own. Results are patches x luminaires. Throws as ComputeColourIlluminance
// does.
#ifndef LUXFIT_APPS_PYTHON_PATCH_LIGHT_H_
#define LUXFIT_APPS_PYTHON_PATCH_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

struct PatchLight {
  Eigen::MatrixXd illuminance_lx, exitance_lm_m2;
};
PatchLight ComputePatchLight(const Room& room, const std::vector<Luminaire>& luminaires,
                             const Eigen::Matrix3Xd& albedo_rgb, const Eigen::Vector3d& weights);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PYTHON_PATCH_LIGHT_H_
