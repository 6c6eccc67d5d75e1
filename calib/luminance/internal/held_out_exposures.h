// How well a response predicts exposures that it was not estimated from.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_HELD_OUT_EXPOSURES_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_HELD_OUT_EXPOSURES_H_

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "calib/luminance/estimate_response.h"

namespace luxfit {

using ResponseSolver = std::function<CameraResponse(const std::vector<BracketSamples>&)>;

// Mean absolute error in counts, one for every bracket and exposure left out: each inner exposure in turn
// (all where a bracket has three) is predicted from the others through the response of what is left of all
// brackets. NaN where nothing can be predicted, whatever the solver.
Eigen::ArrayXd HeldOutErrors(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                             const ResponseSolver& solve);

// The first candidate within one standard error of the best: candidates stand in the order of what they
// assume.
size_t SimplestOfBest(const std::vector<Eigen::ArrayXd>& errors);

// Without the NaN.
double MeanError(const Eigen::ArrayXd& errors);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_HELD_OUT_EXPOSURES_H_
