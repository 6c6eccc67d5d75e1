// The bundle adjustment behind RegisterViews: its state, one solve of it and its residuals.
//
// See calib/register/registration.h for what is minimised and calib/register/internal/reprojection_cost.h for the residuals.
// `scale` is how many times their sigma the corners' residuals really are, from their median (at least 1);
// `reduced_chi2` the mean square without those more than kBundleRejectedSigmas * scale off (at least 1).
// `point_sigma_px` is the same for points, which come without a sigma of their own.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_ADJUSTMENT_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_ADJUSTMENT_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/internal/pose_start.h"
#include "calib/register/registration.h"

namespace luxfit {

constexpr double kBundleRejectedSigmas = 4;

struct PointObservation {
  int point = 0;  // index into BundleAdjustment::points
  Eigen::Vector2d pixel;
  bool used = true;
};

// One view on its way through the adjustment.
struct BundleView {
  std::string name;
  int camera = 0;
  std::vector<TagObservation> tags;
  std::vector<bool> used;  // of each tag
  std::vector<PointObservation> points;
  bool active = false;
  // world_from_cam rotation (x y z w), centre in world: as the solver holds it.
  Eigen::Matrix<double, 7, 1> pose = Eigen::Matrix<double, 7, 1>::Unit(3);

  Eigen::Isometry3d CamFromWorld() const;
  void SetCamFromWorld(const Eigen::Isometry3d& cam_from_world);
};

// How a tag hangs other than TagObservation::corners_in_world says.
struct BundleTag {
  Eigen::Vector3d displacement_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
};

struct BundlePoint {
  Eigen::Vector3d p_in_world = Eigen::Vector3d::Zero();
  std::optional<SurfacePlane> surface;  // that it lies on
};

struct BundleAdjustment {
  std::vector<BundleView> views;
  std::map<int, BundleTag> tags;  // by id
  std::vector<BundlePoint> points;
  double size_error = 0;  // relative, of all tags
  bool converged = false;
  std::string message;
  double cost = 0;          // half the sum of what is minimised
  double scale = 1;         // robust: residuals are this many times their sigma, at least 1
  double reduced_chi2 = 1;  // at least 1
  double point_sigma_px = 0.5;
  double corner_weight_scale = 1;  // beside points, corners weigh by what their residuals say
  int fixed_tag = -1;              // where no tag is surveyed: the one whose pose is the frame
};

struct BundleContext {
  const std::vector<Camera>& cameras;
  const RegisterViewsOptions& options;

  const Camera& CameraOf(const BundleView& view) const {
    return cameras[static_cast<std::size_t>(view.camera)];
  }
};

// Minimises over the active views' poses, the tags, the points that two active views see and the size error;
// sets converged, message, cost, scale, reduced_chi2 and point_sigma_px.
void SolveBundle(const BundleContext& context, BundleAdjustment& adjustment);

// Sets scale, reduced_chi2 and point_sigma_px from the residuals as they are.
void RescaleBundle(const BundleContext& context, BundleAdjustment& adjustment);

// Points that fewer than two active views use have no place: their observations do not count.
std::vector<bool> UsedPoints(const BundleAdjustment& adjustment);

// Where a tag's corners are after the adjustment.
std::array<Eigen::Vector3d, 4> AdjustedCorners(const BundleAdjustment& adjustment, const TagObservation& tag);

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

// |Project(point) - pixel|, px; infinity where it has no image.
double PointErrorPx(const BundleContext& context, const BundleAdjustment& adjustment, const BundleView& view,
                    const PointObservation& observation);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_ADJUSTMENT_H_
