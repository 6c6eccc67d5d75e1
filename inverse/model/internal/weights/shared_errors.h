// Gathers the errors that rows of the light model share, whatever their noise.
//
// Units: those of the rows (relative luminance, lx, px), not weighted.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_SHARED_ERRORS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_SHARED_ERRORS_H_

#include <Eigen/Core>

#include "inverse/model/internal/light_model.h"

namespace luxfit {

// Returns what the size of elements and patches leaves out of each row.
Eigen::VectorXd DiscretisationBias(const LightModel& model, const LightState& state);

// Returns a column for each error, at 1 sigma: what remains of the bias that was subtracted (0: nothing was), and, where
// luminaires have bodies, an error of their reflectance.
Eigen::MatrixXd SharedErrors(const Prediction& at_state, const Eigen::VectorXd& subtracted_bias);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_WEIGHTS_SHARED_ERRORS_H_
