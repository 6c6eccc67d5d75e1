// Returns the covariance of a solved bundle adjustment: of all poses together, with all other unknowns free.
//
//   J^T J = [ B  E ; E^T  C ] with the points last,   Cov(poses, tags, size) = (B - E C^-1 E^T)^-1
//
// C is block-diagonal, 3 x 3 for each point, so points cost no more than their observations. The dense
// inverse has 6 rows for each view and 3 for each tag. Without points the whole is scaled by the reduced
// chi2. With points, corners and points have each been weighted by their own residuals already. Where no tag
// is surveyed, the frame is that of all tags together (calib/register/internal/bundle/free_frame.h).
// Source: Triggs et al. (2000), "Bundle adjustment: a modern synthesis", 6.1 and 9.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_COVARIANCE_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_COVARIANCE_H_

#include <Eigen/Core>
#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

struct BundleCovariance {
  bool determined = false;  // false: no view, or singular normal equations; the rest is empty
  // 6V x 6V, by active view: (rotation vector in world axes rad, camera centre in world m). Poses share the
  // errors of the tags, so their errors are correlated.
  Eigen::MatrixXd of_poses;
  double size_error_sigma = 0;
  double variance_factor = 1;                     // what the whole was scaled by
  std::vector<int> displaced_tags;                // surveyed tags in use that may be off their places
  std::vector<Eigen::Matrix3d> of_displacements;  // of each of these (m2), before that factor
};
BundleCovariance ComputeBundleCovariance(const BundleContext& context, BundleAdjustment& adjustment);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_COVARIANCE_H_
