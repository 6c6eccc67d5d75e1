// One lens fitted to all corners, outliers found on the way.
//
// After each adjustment the noise is estimated from the residuals, corners further than `outlier_sigmas` of
// it are left out (and come back where they fit again), until nothing changes. The noise is that of the
// median first (sigma = median |r| / 1.177 for two axes), which stands 40 % of wrong corners, then that of
// the corners in use.
//
// Source: Rousseeuw and Leroy (1987), "Robust regression and outlier detection".
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_FIT_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_FIT_H_

#include <string>
#include <vector>

#include "calib/calibrate/calibration.h"
#include "calib/calibrate/internal/calibration_seed.h"
#include "calib/calibrate/internal/calibration_state.h"

namespace luxfit {

struct LensFitOptions {
  CalibrationBackEnd back_end = CalibrationBackEnd::kMrcal;
  double outlier_sigmas = 4;
  bool warp = false;
};

struct LensFit {
  bool ok = false;
  std::string message;  // why not
  CalibrationState state;
  std::vector<bool> used;      // by corner of the problem; false: an outlier
  Eigen::Matrix2Xd residuals;  // px, of all corners
  double noise_px = 0;         // per axis, of a corner of weight 1; from the residuals and their freedom
};

// The adjustment alone, by whichever solver can do it.
SolvedState SolveCalibration(const CalibrationProblem& problem, const CalibrationState& start,
                             const SolveSelection& selection, CalibrationBackEnd back_end);
LinearizedState LinearizeCalibration(const CalibrationProblem& problem, const CalibrationState& state,
                                     const SolveSelection& selection);

// `simpler`: a fit of fewer coefficients of the same family to start from, if there is one.
LensFit FitLens(CalibrationProblem problem, const CalibrationSeed& seed, const LensKind& kind,
                const LensFit* simpler, const LensFitOptions& options);

// The same from a state of that lens.
LensFit FitFrom(CalibrationProblem problem, CalibrationState start, const LensFitOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_FIT_H_
