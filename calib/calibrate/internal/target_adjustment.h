// Solves the adjustment by Ceres, with the derivatives of any lens function.
//
// Serves what libmrcal's optimiser cannot express: fisheye lenses, and rigs before targets that are no
// uniform grid. Unknowns and their order are libmrcal's: lens parameters, then poses as Rodrigues vector and
// translation.
//
// A weak prior holds distortion near zero: one pixel of residual for a coefficient of 1000, or for a control
// point 0.2 away. Only unknowns that no corner determines feel it.
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
