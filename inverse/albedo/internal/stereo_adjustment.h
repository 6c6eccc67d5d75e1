// Photometric stereo as one adjustment: every pixel's albedo and normal together with what all pixels share.
//
//   min sum_ik rho((v_ik - s_k |b_i| f(b_i/|b_i|, l_k) - a) / sigma)
//       + sum_k N_k angle(l_k, given)^2 / sigma_k^2
//
// b = albedo * normal of pixel i, l_k: direction to the light of image k, s_k: its strength, f and a: the
// reflectance curve, rho: Cauchy's. Levenberg-Marquardt; the pixels' 3 x 3 blocks are eliminated (Schur), so
// that a step costs one pass over the observations and a solve of the few shared unknowns. sigma is refreshed
// from the median absolute residual.
//
// The residuals of one image share their model error: N_k, the number of its observations, makes them count
// as one observation against what is known of its light's direction.
//
// Strengths are free up to one factor, which the albedo takes: the mean of their logarithms stays.
// Source: Triggs et al. (2000), "Bundle adjustment", sec. 4 and 6.
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_ADJUSTMENT_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_ADJUSTMENT_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/albedo/reflectance_curve.h"

namespace luxfit {

using ObservationMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;  // images x pixels

struct StereoProblem {
  Eigen::MatrixXd value;                // images x pixels, of the order of 1
  ObservationMask used;                 // images x pixels; value is finite there
  Eigen::Matrix3Xd to_light;            // as given
  Eigen::VectorXd direction_sigma_rad;  // 0: held
  bool strengths_free = false;
  bool robust = true;
};

struct StereoState {
  Eigen::Matrix3Xd b;  // albedo * normal, one a pixel
  Eigen::Matrix3Xd to_light;
  Eigen::VectorXd strength;
  ReflectanceCurve curve;
};

struct StereoAdjustment {
  StereoState state;
  double residual_sigma = 0;
  int iterations = 0;
  bool converged = false;
};

// Linear least squares, with what is not `used` left out; 0 where fewer than three lights span the space.
Eigen::Matrix3Xd SolveLambert(const StereoProblem& problem, const Eigen::VectorXd& strength);

// `start.b` from SolveLambert or better; pixels whose b is 0 take no part.
StereoAdjustment AdjustStereo(const StereoProblem& problem, const StereoState& start,
                              int max_iterations = 40);

// value - model, NaN where the value is not finite or the pixel takes no part.
Eigen::MatrixXd StereoResiduals(const StereoProblem& problem, const StereoState& state);

// Covariance of every pixel's b: its own, and what the shared unknowns' covariance adds. Theirs is the
// cluster-robust one with one cluster an image, never below the plain one.
std::vector<Eigen::Matrix3d> StereoCovariance(const StereoProblem& problem,
                                              const StereoAdjustment& adjustment);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_ADJUSTMENT_H_
