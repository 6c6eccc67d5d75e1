// Measures how well a response predicts exposures that were left out of its estimate.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_HELD_OUT_EXPOSURES_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_HELD_OUT_EXPOSURES_H_

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "calib/luminance/response.h"

namespace luxfit {

using ResponseSolver = std::function<CameraResponse(const std::vector<BracketSamples>&)>;

// Tells whether no bracket has three exposures.
bool AreOnlyPairs(const std::vector<BracketSamples>& brackets);

// Returns mean absolute errors in counts, one for every bracket and exposure left out. Each inner exposure in
// turn (each one where a bracket has three) is predicted from the others. The prediction uses the response of
// what is left of all brackets. Where no bracket has three, each half of the pixels in turn is left out instead, and
// its exposures are predicted from one another. NaN where nothing can be predicted, whatever the solver.
Eigen::ArrayXd HeldOutErrors(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                             const ResponseSolver& solve);

// Returns the first candidate within one standard error of the best. Candidates are in the order of their
// assumptions, the most first.
size_t SimplestOfBest(const std::vector<Eigen::ArrayXd>& errors);

// Returns the mean of the errors that are not NaN; 0 where there are none.
double MeanError(const Eigen::ArrayXd& errors);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_HELD_OUT_EXPOSURES_H_
