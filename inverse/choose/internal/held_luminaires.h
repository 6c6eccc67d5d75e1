// Counts the direct light of luminaires that stay as they are as known light, as indirect light is.
//
//   I_es <- I_es + c / pi * sum_k d_sk Phi_k D_ek     k: luminaires that stay, D: direct illuminance per lumen
//
// The problem of one luminaire among sixty then costs what it costs alone, for every model that is tried. The rows are
// the same: a row's offset takes the held luminaires' light, and the reflectance multiplies both
// (inverse/model/internal/blocks/photo_block.h).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_HELD_LUMINAIRES_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_HELD_LUMINAIRES_H_

#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_state.h"

namespace luxfit {

// Returns the observations with the direct light of all luminaires of `state` but `members` in relative_indirect, and
// without those that no fit uses: a held luminaire's shadow edge crosses their elements (LightModel::InPenumbra).
// `dimming`: by state, of all luminaires. The observations hold their indirect light already.
std::vector<Observation> WithHeldLight(const Room& room, const std::vector<Eigen::VectorXd>& dimming,
                                       const LightState& state, const std::vector<int>& members,
                                       std::vector<Observation> observations);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_HELD_LUMINAIRES_H_
