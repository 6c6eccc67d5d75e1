// Estimates how precisely a count determines its exposure, from how exposures of one pixel disagree.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_NOISE_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_NOISE_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "calib/luminance/response.h"

namespace luxfit {

// Returns the standard deviation of ln X at each of the response's knots, one vector for each channel:
//
//   r_ij = ln f(z_ij) - ln t_j - mean of (ln f(z_ik) - ln t_k) over k != j
//   var(r) = sigma^2(z_ij) + variance of that mean
//
// It is taken by bins of counts, from the median absolute residual. The weights of the means are 1 / sigma^2
// of the round before. Bins with fewer than 30 residuals take their neighbour's.
std::array<Eigen::VectorXd, 3> RelativeSigma(const std::vector<BracketSamples>& brackets,
                                             const CameraResponse& response, const ResponseOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_RESPONSE_NOISE_H_
