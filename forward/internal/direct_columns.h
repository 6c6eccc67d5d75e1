// Direct light of all luminaires at one place, and its derivatives, as one row of a matrix.
#ifndef LUXFIT_FORWARD_INTERNAL_DIRECT_COLUMNS_H_
#define LUXFIT_FORWARD_INTERNAL_DIRECT_COLUMNS_H_

#include <Eigen/Core>
#include <vector>

#include "forward/illuminance.h"

namespace luxfit {

// rows x (luminaires + parameters), lx per lm: elements of the room first row by row, then those receivers that are sensors.
struct DirectColumns {
  Eigen::MatrixXf elements;
  Eigen::MatrixXf receivers;
};
DirectColumns ComputeDirectColumns(const Room& room, const Receivers& receivers, const LuminaireVisibility& visibility,
                                   const std::vector<Luminaire>& luminaires,
                                   const std::vector<LuminaireParameter>& parameters);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_INTERNAL_DIRECT_COLUMNS_H_
