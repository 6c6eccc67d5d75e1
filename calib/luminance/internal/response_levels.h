// The 256 knots that a response is estimated at, and which counts of a sample say something about it.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_LEVELS_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_LEVELS_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "calib/luminance/estimate_response.h"

namespace luxfit {

constexpr Eigen::Index kResponseLevels = 256;

// A count between two knots.
struct LevelPosition {
  Eigen::Index below = 0;  // 0..254
  double share = 0;        // of the knot above
};
LevelPosition PositionOf(double counts, double full_scale_counts);

// Whether a count is neither dark nor saturated.
bool IsInRange(double counts, const ResponseOptions& options);

// Throws std::invalid_argument as estimate_response.h says.
void CheckSamples(const std::vector<BracketSamples>& brackets);

// ln f at the knots, one curve a channel, as a response in the gauge of response.h.
CameraResponse ResponseOf(std::array<Eigen::VectorXd, 3> log_exposure, double full_scale_counts);

// The nearest sequence (least squares with these weights > 0) that does not decrease, then with steps of at
// least `least_step`.
Eigen::VectorXd Monotone(const Eigen::VectorXd& values, const Eigen::VectorXd& weights, double least_step);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_LEVELS_H_
