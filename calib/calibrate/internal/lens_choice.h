// Chooses the lens that the corners support: candidates fitted by complexity, scored on sets held out.
//
// calib/calibrate/calibration.h states the rule. The scores leave out corners that are outliers to every
// candidate. A corner that only a poor lens cannot explain counts against that lens.
#ifndef LUXFIT_CALIB_CALIBRATE_INTERNAL_LENS_CHOICE_H_
#define LUXFIT_CALIB_CALIBRATE_INTERNAL_LENS_CHOICE_H_

#include <string>
#include <vector>

#include "calib/calibrate/calibration.h"
#include "calib/calibrate/internal/calibration_fit.h"

namespace luxfit {

struct HeldOutScore {
  // By set: sum of w^2 |r|^2, px^2. NaN: no score. Infinity: the lens of the other folds has no image of it,
  // or could not be fitted.
  std::vector<double> squares;
  std::vector<double> freedom;  // by set: 2 n - 6
  double PerAxisPx() const;     // NaN where no set has a score
};

// Returns the score of a fit on the corners `counted`, by k-fold cross-validation over sets. All scores are
// NaN where there are fewer than three sets.
HeldOutScore ScoreHeldOut(const CalibrationProblem& problem, const LensFit& fit,
                          const std::vector<bool>& counted, int folds, const LensFitOptions& options);

struct LensCandidate {
  LensKind kind;
  LensFit fit;
  HeldOutScore score;
  std::vector<bool> counted;  // corners that the score counts
};

struct LensChoice {
  std::vector<LensCandidate> candidates;
  int chosen = -1;  // -1: no candidate could be fitted
  std::string because;
};

// Fits the kinds in order of complexity and chooses among them; `because` says why.
LensChoice ChooseLens(const CalibrationProblem& problem, const CalibrationSeed& seed,
                      const std::vector<LensKind>& kinds, int folds, const LensFitOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_INTERNAL_LENS_CHOICE_H_
