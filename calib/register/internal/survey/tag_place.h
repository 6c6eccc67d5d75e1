// Finds where the photos show a tag, by the poses that all other tags give.
//
//   min over d of   r(d)^T S^-1 r(d),   r(d) = Project(cam_from_world_v (p_corner + d)) - corner_px
//   S = c sigma_px^2 I + J_pose Cov(poses) J_pose^T + J_e sigma_e^2 J_e^T,   Cov(d) = (J_d^T S^-1 J_d)^-1
//   W = d^T (Cov(d) + survey_sigma^2 I)^-1 d
//
// The corners p_corner are those of the survey, c is the variance factor of the adjustment, e the relative error of the
// printed size, common to all tags, with its sigma; what it shares with the poses is neglected. The tag must not have
// taken part in the adjustment: W then tests the survey of this tag alone, whatever it would have done to the poses.
// A tag of another size, a turned one, or one in two places fits no single d: `misfit` is large then.
//
// Source: Baarda (1968), "A testing procedure for use in geodetic networks"; Gauss-Newton for d.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_TAG_PLACE_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_TAG_PLACE_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"
#include "calib/register/internal/bundle/bundle_covariance.h"

namespace luxfit {

struct TagPlace {
  Eigen::Vector3d displacement_m;  // d, world
  Eigen::Matrix3d covariance_m2;   // Cov(d)
  double misfit = 0;               // r^T S^-1 r at d, over its degrees of freedom (8 a view, less 3)
  int views = 0;                   // that show the tag and have a pose

  // Returns whether all its corners lie in one place, within the sigmas by which corners are rejected.
  bool IsOnePlace() const { return misfit < kBundleRejectedSigmas * kBundleRejectedSigmas; }
  // Returns sqrt(W): how far the tag is off its surveyed place.
  double Sigmas(double survey_sigma_m) const;
  // Returns the sigma of |d|, m.
  double DistanceSigma() const;
};

// Returns the place of tag `id`; nothing where no view with a pose shows it, or no place does. `covariance` is that of
// `adjustment`; `detections` are of its views.
std::optional<TagPlace> FindTagPlace(const BundleContext& context, const BundleAdjustment& adjustment,
                                     const BundleCovariance& covariance, const SurveyedTag& surveyed,
                                     const std::vector<ViewDetections>& detections);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_SURVEY_TAG_PLACE_H_
