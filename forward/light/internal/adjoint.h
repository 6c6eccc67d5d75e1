// Returns all derivatives of one weighted sum of illuminances, by one adjoint solve.
//
//   J = sum_r w_r E_r,   E as in forward/light/illuminance.h,   M = (I - rho F)^-1 rho D_p
//   g = G^T w_s                              J per exitance emitted at an element, towards sensors
//   a = (I - F^T rho)^-1 F_e^T (w_e + rho g) adjoint: J per exitance emitted at a patch
//   dJ/dD_p = rho a,   dJ/dD_e = rho g,   dJ/drho_i = a_i E_i + sum over its elements of g_e E_e
//
// Forward mode (forward/light/illuminance.h) costs one column of light for each parameter. The adjoint costs
// one column for each sum, whatever the number of parameters: reflectances of all patches, direct light of
// all elements, and through it all parameters of all luminaires.
//
// Shapes: w receivers; results by patch, element, receiver, material and parameter. Luminaires are at their
// flux_lm; J is in lx.
//
// Throws std::invalid_argument unless there is a weight for every receiver. Source: Pattanaik and Mudur
// (1995), "Adjoint equations and random walks for illumination computation"; Giles and Pierce (2000), "An
// introduction to the adjoint approach to design".
#ifndef LUXFIT_FORWARD_LIGHT_INTERNAL_ADJOINT_H_
#define LUXFIT_FORWARD_LIGHT_INTERNAL_ADJOINT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/illuminance.h"

namespace luxfit {

struct AdjointDerivatives {
  double sum_lx = 0;               // J
  Eigen::VectorXd d_patch_albedo;  // by patch: each patch's reflectance for itself
  Eigen::VectorXd d_albedo;        // by material
  Eigen::VectorXd d_flux;          // by luminaire, lx/lm
  Eigen::VectorXd d_parameters;    // by derivatives.parameters, lx per unit of each
};

// Returns derivatives with respect to all materials, whether `derivatives` names them or not.
AdjointDerivatives ComputeAdjoint(const Room& room, const Receivers& receivers,
                                  const LuminaireVisibility& visibility,
                                  const std::vector<Luminaire>& luminaires, const Eigen::VectorXd& albedo,
                                  const Eigen::VectorXd& weights, const DerivativeRequest& derivatives = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_INTERNAL_ADJOINT_H_
