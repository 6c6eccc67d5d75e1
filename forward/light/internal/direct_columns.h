// Returns the direct light of all luminaires at all places, and its derivatives, as columns.
//
// Shapes are rows x (luminaires + parameters), lx per lm. Derivatives hold visibility fixed unless moving
// shadows are requested. Then places that see a part of a luminaire get those of
// forward/direct/internal/shadowed_light.h.
//
// Throws std::invalid_argument for luminaires that are not valid.
#ifndef LUXFIT_FORWARD_LIGHT_INTERNAL_DIRECT_COLUMNS_H_
#define LUXFIT_FORWARD_LIGHT_INTERNAL_DIRECT_COLUMNS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/illuminance.h"

namespace luxfit {

struct DirectColumns {
  Eigen::MatrixXf elements;  // all elements of the room; luminaires alone where derivatives are not reflected
  Eigen::MatrixXf receivers;
};
DirectColumns ComputeDirectColumns(const Room& room, const Receivers& receivers,
                                   const LuminaireVisibility& visibility,
                                   const std::vector<Luminaire>& luminaires,
                                   const DerivativeRequest& derivatives);

// Returns the columns of the receivers alone; `visibility` needs no more.
Eigen::MatrixXf ComputeReceiverColumns(const Room& room, const Receivers& receivers,
                                       const LuminaireVisibility& visibility,
                                       const std::vector<Luminaire>& luminaires,
                                       const DerivativeRequest& derivatives);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_LIGHT_INTERNAL_DIRECT_COLUMNS_H_
