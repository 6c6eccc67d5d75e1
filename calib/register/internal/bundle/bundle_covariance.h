// Returns the covariance of a solved bundle adjustment: of every view's pose, with all other unknowns free.
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
  bool determined = false;  // false: the normal equations are singular, and the rest is empty
  // By active view: (rotation vector in world axes, camera centre).
  std::vector<Eigen::Matrix<double, 6, 6>> of_views;
  double size_error_sigma = 0;
};
BundleCovariance ComputeBundleCovariance(const BundleContext& context, BundleAdjustment& adjustment);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_COVARIANCE_H_
