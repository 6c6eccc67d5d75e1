// Returns the reflectance of every element, from those of materials and the factors of patches.
//
//   rho_e = rho_m(e) f_j(e), at most Transport::kMostReflectance where there are factors
//
// `albedo`: by material of the scene. `patch_factor`: f by patch, as Transport takes it; empty for 1.
#ifndef LUXFIT_FORWARD_LIGHT_ELEMENT_ALBEDO_H_
#define LUXFIT_FORWARD_LIGHT_ELEMENT_ALBEDO_H_

#include <Eigen/Core>

#include "forward/room/patches.h"

namespace luxfit {

Eigen::VectorXf ElementAlbedo(const Patches& patches, const Eigen::VectorXd& albedo,
                              const Eigen::VectorXd& patch_factor = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_ELEMENT_ALBEDO_H_
