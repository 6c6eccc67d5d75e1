// Solves photometric stereo as one adjustment of every pixel's albedo and normal and all shared unknowns.
//
//   min sum_ik rho((v_ik - s_k |b_i| f(b_i/|b_i|, l_k) - a) / sigma)
//       + sum_k N_k angle(l_k, given)^2 / sigma_k^2
//
// b_i: albedo * normal of pixel i, l_k: direction to the light of image k, s_k: its strength. f, a: the
// reflectance curve, rho: Cauchy's loss. Ceres takes one step of the few shared unknowns, from which the
// pixels are eliminated (pixel_elimination.h). Then the robust weights and sigma are refreshed (IRLS), as in
// the fit of a room. sigma follows from the median absolute residual.
//
// The residuals of one image share their model error. N_k, the number of its observations, makes them count
// as one observation against the given direction of its light.
//
// Strengths are free up to one factor, which the albedo absorbs: the mean of their logarithms stays.
// Sources: Triggs et al. (2000), "Bundle adjustment", sec. 4 and 6; Golub and Pereyra (1973).
#ifndef LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_ADJUSTMENT_H_
#define LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_ADJUSTMENT_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/albedo/reflectance_curve.h"

namespace luxfit {

using ObservationMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;  // images x pixels

struct StereoProblem {
  Eigen::MatrixXd value;                // images x pixels, about 1 in size
  ObservationMask used;                 // images x pixels; the value is finite where true
  Eigen::Matrix3Xd to_light;            // as given
  Eigen::VectorXd direction_sigma_rad;  // 0: held
  bool strengths_free = false;
  bool robust = true;
};

struct StereoState {
  Eigen::Matrix3Xd b;  // albedo * normal, one for each pixel
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

// Returns b by linear least squares over the `used` values; 0 where fewer than three lights span the space.
Eigen::Matrix3Xd SolveLambert(const StereoProblem& problem, const Eigen::VectorXd& strength);

// `start.b`: from SolveLambert or better. Pixels whose b is 0 take no part.
StereoAdjustment AdjustStereo(const StereoProblem& problem, const StereoState& start,
                              int max_iterations = 40);

// Returns value - model; NaN where the value is not finite or the pixel takes no part.
Eigen::MatrixXd StereoResiduals(const StereoProblem& problem, const StereoState& state);

// Returns the covariance of every pixel's b: its own, plus the part by the shared unknowns. The covariance of
// the shared unknowns is cluster-robust with one cluster for each image, never below the plain one.
std::vector<Eigen::Matrix3d> StereoCovariance(const StereoProblem& problem,
                                              const StereoAdjustment& adjustment);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_INTERNAL_STEREO_ADJUSTMENT_H_
