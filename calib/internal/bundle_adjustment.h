// The bundle adjustment behind RegisterViews: its state, one solve of it, its residuals and covariance.
//
// See calib/registration.h for what is minimised and calib/internal/reprojection_cost.h for the residuals.
// `scale` is how many times their sigma the residuals really are, from their median (at least 1);
// `reduced_chi2` the mean square without those more than kBundleRejectedSigmas * scale off (at least 1).
#ifndef LUXFIT_CALIB_INTERNAL_BUNDLE_ADJUSTMENT_H_
#define LUXFIT_CALIB_INTERNAL_BUNDLE_ADJUSTMENT_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "calib/internal/pose_start.h"
#include "calib/registration.h"

namespace luxfit {

constexpr double kBundleRejectedSigmas = 4;

// One view on its way through the adjustment.
struct BundleView {
  std::string name;
  int camera = 0;
  std::vector<TagObservation> tags;
  std::vector<bool> used;  // of each tag
  bool active = false;
  Eigen::Quaterniond world_from_cam = Eigen::Quaterniond::Identity();
  Eigen::Vector3d center_in_world = Eigen::Vector3d::Zero();

  Eigen::Isometry3d CamFromWorld() const {
    Eigen::Isometry3d world_from_camera = Eigen::Isometry3d::Identity();
    world_from_camera.linear() = world_from_cam.toRotationMatrix();
    world_from_camera.translation() = center_in_world;
    return world_from_camera.inverse();
  }
};

struct BundleAdjustment {
  std::vector<BundleView> views;
  std::map<int, Eigen::Vector3d> displacement_m;  // by tag id; zero if the survey is exact
  double size_error = 0;                          // relative, of all tags
  bool converged = false;
  std::string message;
  double scale = 1;         // robust: residuals are this many times their sigma, at least 1
  double reduced_chi2 = 1;  // at least 1
};

struct BundleContext {
  const std::vector<Camera>& cameras;
  const RegisterViewsOptions& options;
};

// Minimises over the active views' poses, the displacements and the size error; sets converged, message,
// scale and reduced_chi2.
void SolveBundle(const BundleContext& context, BundleAdjustment& adjustment);

struct BundleCornerError {
  Eigen::Vector2d error_px;
  double sigmas = 0;  // |error_px| / sigma_px
};
std::vector<BundleCornerError> BundleTagErrors(const BundleContext& context,
                                               const BundleAdjustment& adjustment, const BundleView& view,
                                               std::size_t tag_index);
std::vector<BundleCornerError> BundleViewErrors(const BundleContext& context,
                                                const BundleAdjustment& adjustment, const BundleView& view);
// rms per axis, in sigmas.
double BundleRmsSigmas(const std::vector<BundleCornerError>& errors);

struct BundleCovariance {
  bool determined = false;  // false: the normal equations are singular, and the rest is empty
  // (rotation vector in world axes, camera centre) of each active view, scaled by the reduced chi2.
  std::vector<Eigen::Matrix<double, 6, 6>> of_views;
  double size_error_sigma = 0;
};
BundleCovariance ComputeBundleCovariance(const BundleContext& context, BundleAdjustment& adjustment);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_INTERNAL_BUNDLE_ADJUSTMENT_H_
