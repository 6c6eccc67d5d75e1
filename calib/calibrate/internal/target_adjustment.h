// The adjustment by Ceres, with the derivatives of any lens function: for what libmrcal's optimiser cannot
// pose, fisheye lenses and rigs before boards that are no uniform grid.
//
// Unknowns and their order are those of libmrcal's: lens parameters, poses as Rodrigues vector and
// translation. Distortion is held near zero so weakly (one pixel of residual for a coefficient of 1000, or a
// control point 0.2 away) that only what no corner determines feels it.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_TARGET_ADJUSTMENT_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_TARGET_ADJUSTMENT_H_

#include "calib/calibrate/internal/calibration_state.h"

namespace luxfit {

SolvedState SolveByCeres(const CalibrationProblem& problem, const CalibrationState& start,
                         const SolveSelection& selection);

LinearizedState LinearizeByCeres(const CalibrationProblem& problem, const CalibrationState& state,
                                 const SolveSelection& selection);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_TARGET_ADJUSTMENT_H_
