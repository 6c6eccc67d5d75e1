// Which lens the corners support: candidates fitted in order of complexity, scored on sets held out.
//
// The rule is calib/calibrate/calibration.h's. Corners that are outliers to every candidate are left out of the scores;
// one that a poor lens alone cannot explain counts against it.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_LENS_CHOICE_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_LENS_CHOICE_H_

#include <string>
#include <vector>

#include "calib/calibrate/calibration.h"
#include "calib/calibrate/internal/calibration_fit.h"

namespace luxfit {

struct HeldOutScore {
  // By set: sum of w^2 |r|^2, px^2. NaN: no score; infinity: the lens of the others has no image of it.
  std::vector<double> squares;
  std::vector<double> freedom;  // by set: 2 n - 6
  double PerAxisPx() const;     // NaN where no set has a score
};

HeldOutScore ScoreHeldOut(const CalibrationProblem& problem, const LensFit& fit,
                          const std::vector<bool>& counted, int folds, const LensFitOptions& options);

struct LensCandidate {
  LensKind kind;
  LensFit fit;
  HeldOutScore score;
  std::vector<bool> counted;  // corners in that score
};

struct LensChoice {
  std::vector<LensCandidate> candidates;
  int chosen = -1;  // none could be fitted
  std::string because;
};

LensChoice ChooseLens(const CalibrationProblem& problem, const CalibrationSeed& seed,
                      const std::vector<LensKind>& kinds, int folds, const LensFitOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_LENS_CHOICE_H_
