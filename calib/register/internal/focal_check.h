// Checks the focal lengths that a registration was given against those that its surveyed tags show.
//
//   c(s) = min over everything else of the bundle's cost, with the camera's fx and fy times s
//   c'(s) = 0,   sigma_s^2 = chi2 / c''(s)                        (profile likelihood, central differences)
//
// A focal length from a file name, EXIF or another lens setting is off by per cents. Every pose is then off
// along its view by as much. No residual of a pose shows it, but tags at several depths together do.
// Source: Venzon and Moolgavkar (1988), "A method for computing profile-likelihood-based confidence
// intervals".
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_FOCAL_CHECK_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_FOCAL_CHECK_H_

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

struct FocalScale {
  double scale = 1;  // factor on fx and fy
  double sigma = 0;  // sigma of the scale
  // Derivatives of (rotation vector in world axes, camera centre in world) by the scale, for each view with
  // tags.
  std::map<std::string, Eigen::Matrix<double, 6, 1>> pose_derivatives;

  // Returns whether the scale differs from 1 by more than the tags' noise (4 sigma) and more than lens models
  // leave (a thousandth).
  bool IsOff() const;
};

// Returns the scale of one camera from a solved adjustment of surveyed tags; nothing where they do not
// determine it.
std::optional<FocalScale> EstimateFocalScale(const BundleContext& context, const BundleAdjustment& solved,
                                             int camera);

// Returns the scale from 0.62 to 1.6 with which most tags agree on poses. These must be eight tenths of the
// tags, and a tenth more than as given; else the scale is 1.
double FindFocalScale(const BundleContext& context, const std::vector<BundleView>& views, int camera);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_FOCAL_CHECK_H_
