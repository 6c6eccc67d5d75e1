// Fits one lens to all corners and finds the outliers.
//
// Each round estimates the noise from the adjustment's residuals and leaves out corners further than
// `outlier_sigmas` of it. Corners come back where they fit again. The rounds end when nothing changes. The
// first rounds take the noise from the median (sigma = median |r| / 1.177 for two axes), which withstands 40
// % of wrong corners. Later rounds take it from the corners in use.
//
// A set that ends with fewer than six corners in use has no determined pose: it is left out whole.
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
  std::string message;  // says why the fit failed
  CalibrationState state;
  std::vector<bool> used;      // by corner of the problem; false: an outlier
  Eigen::Matrix2Xd residuals;  // px, for all corners
  double noise_px = 0;         // per axis, for a corner of weight 1, over the degrees of freedom
};

// Solve the adjustment alone, or return its derivatives, by whichever solver can do it.
SolvedState SolveCalibration(const CalibrationProblem& problem, const CalibrationState& start,
                             const SolveSelection& selection, CalibrationBackEnd back_end);
LinearizedState LinearizeCalibration(const CalibrationProblem& problem, const CalibrationState& state,
                                     const SolveSelection& selection);

// Fits a kind of lens from the seed, or from `simpler`: a fit of fewer coefficients of the same family, if
// there is one.
LensFit FitLens(CalibrationProblem problem, const CalibrationSeed& seed, const LensKind& kind,
                const LensFit* simpler, const LensFitOptions& options);

// Fits a lens from a state of that lens.
LensFit FitFrom(CalibrationProblem problem, CalibrationState start, const LensFitOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_CALIBRATION_FIT_H_
