// Solves the adjustment by libmrcal's optimiser.
//
// A uniform grid becomes mrcal's calibration board, seen by cameras fixed to each other. Any other target
// becomes mrcal's fixed points, seen by one camera that moves. libmrcal aborts the process on models and
// sizes that it does not know: everything is checked before the call, and the result is checked to be finite.
// Outliers are not left to libmrcal, which finds them among boards only: unused corners are given as such.
//
// Does not serve fisheye lenses, nor several cameras on a target that is no uniform grid (`MrcalCanSolve`).
// Source: mrcal 2.2, "Calibration formulation".
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_MRCAL_CALIBRATION_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_MRCAL_CALIBRATION_H_

#include "calib/calibrate/internal/calibration_state.h"

namespace luxfit {

bool MrcalCanSolve(const CalibrationProblem& problem, const LensKind& kind);

SolvedState SolveByMrcal(const CalibrationProblem& problem, const CalibrationState& start,
                         const SolveSelection& selection);

// Returns the derivatives at any state, by the optimiser's callback. Throws std::runtime_error where libmrcal
// refuses it.
LinearizedState LinearizeByMrcal(const CalibrationProblem& problem, const CalibrationState& state,
                                 const SolveSelection& selection);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_MRCAL_CALIBRATION_H_
