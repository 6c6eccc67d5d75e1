// Defines the 256 knots at which a response is estimated, and the counts of a sample that determine it.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_LEVELS_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_LEVELS_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "calib/luminance/response.h"

namespace luxfit {

constexpr Eigen::Index kResponseLevels = 256;
constexpr double kLeastLogStep = 1e-5;  // of ln f from one knot to the next

// Holds the position of a count between two knots.
struct LevelPosition {
  Eigen::Index below = 0;  // 0..254
  double share = 0;        // weight of the knot above
};
LevelPosition PositionOf(double counts, double full_scale_counts);

// Returns whether a count is neither dark nor saturated.
bool IsInRange(double counts, const ResponseOptions& options);

// Throws std::invalid_argument as calib/luminance/response.h states.
void CheckSamples(const std::vector<BracketSamples>& brackets);

// Returns the response with ln f at the knots, one curve for each channel, in the gauge of
// calib/luminance/response.h.
CameraResponse ResponseOf(std::array<Eigen::VectorXd, 3> log_exposure, double full_scale_counts);

// Returns the nearest sequence (least squares) that does not decrease, then raised to steps of at least
// `least_step`.
Eigen::VectorXd Monotone(const Eigen::VectorXd& values, double least_step);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_LEVELS_H_
