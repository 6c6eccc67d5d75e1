// Returns the indirect light at receivers, from that at the elements of the room.
//
//   element:  E = F M                          M: exitance of patches
//   sensor:   E = G M_e,  M_e = rho (D + F M)  G: Receivers::sensor_to_element, D: direct light of elements
//
// Columns are independent light sources, or derivatives of them.
#ifndef LUXFIT_FORWARD_LIGHT_INTERNAL_GATHER_H_
#define LUXFIT_FORWARD_LIGHT_INTERNAL_GATHER_H_

#include <Eigen/Core>

#include "forward/light/element_albedo.h"
#include "forward/light/room.h"

namespace luxfit {

// Returns receivers x columns, from the elements' indirect illuminance and exitance (elements x columns).
Eigen::MatrixXf GatherAtReceivers(const Receivers& receivers, const Eigen::MatrixXf& element_indirect_lx,
                                  const Eigen::MatrixXf& element_exitance);

// Returns whether PrepareGather was called for the receivers.
bool IsPrepared(const Receivers& receivers);

// Returns the light of surfaces that shine: receivers x columns. `emitted`: elements x columns, what elements give beside
// what they reflect; `exitance`: patches x columns, both together. `albedo`: by material, all patches are like it.
Eigen::MatrixXf GatherEmitted(const Room& room, const Receivers& receivers, const Eigen::VectorXd& albedo,
                              const Eigen::MatrixXf& emitted, const Eigen::MatrixXf& exitance);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_INTERNAL_GATHER_H_
