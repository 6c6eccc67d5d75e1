// Solves the bundle adjustment behind RegisterViews: its state, one solve of it and its residuals.
//
// calib/register/registration.h states the objective, calib/register/internal/bundle/reprojection_cost.h the
// residuals. `scale` is the ratio of the corners' residuals to their sigma, from the median (at least 1).
// `reduced_chi2` is the mean square without residuals of more than kBundleRejectedSigmas * scale (at least
// 1). `point_sigma_px` is the sigma of points, which come without one of their own.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_ADJUSTMENT_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_ADJUSTMENT_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/register/internal/bundle/pose_start.h"
#include "calib/register/registration.h"

namespace luxfit {

constexpr double kBundleRejectedSigmas = 4;

struct PointObservation {
  int point = 0;  // index into BundleAdjustment::points
  Eigen::Vector2d pixel;
  bool used = true;
};

// Holds where its tags alone place a view, and those among them that agree with one another.
struct TagStart {
  std::vector<bool> used;  // by tag
  Eigen::Matrix<double, 7, 1> pose;
};

// Holds one view during the adjustment.
struct BundleView {
  std::string name;
  int camera = 0;
  std::vector<TagObservation> tags;
  std::vector<bool> used;  // by tag
  std::vector<PointObservation> points;
  bool active = false;
  // world_from_cam rotation (x y z w), centre in world: the solver's form.
  Eigen::Matrix<double, 7, 1> pose = Eigen::Matrix<double, 7, 1>::Unit(3);
  std::optional<TagStart> by_tags;  // of a view that features placed otherwise, where two tags and more do

  int TagsUsed() const { return static_cast<int>(std::count(used.begin(), used.end(), true)); }
  Eigen::Isometry3d CamFromWorld() const;
  void SetCamFromWorld(const Eigen::Isometry3d& cam_from_world);
};

// Holds how a tag hangs relative to TagObservation::corners_in_world.
struct BundleTag {
  Eigen::Vector3d displacement_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  std::optional<SurfacePlane> surface;  // surface that it lies on, within its sigma
};

struct BundlePoint {
  Eigen::Vector3d p_in_world = Eigen::Vector3d::Zero();
  std::optional<SurfacePlane> surface;  // surface that it lies on
};

// Tells a user what to look at where photos and tags do not go together.
inline constexpr char kWhyNothingFits[] =
    "the intrinsics may be of another lens model, camera or picture size, or the tags hang elsewhere than "
    "the map "
    "says";

struct BundleAdjustment {
  std::vector<BundleView> views;
  std::map<int, BundleTag> tags;  // by id
  std::vector<BundlePoint> points;
  double size_error = 0;  // relative, common to all tags
  bool converged = false;
  std::string message;
  double cost = 0;          // half the minimised sum
  double scale = 1;         // robust ratio of residuals to their sigma, at least 1
  double reduced_chi2 = 1;  // at least 1
  double point_sigma_px = 0.5;
  double corner_weight_scale = 1;  // beside points, corners weigh by their residuals
  int fixed_tag = -1;              // without surveyed tags: the one whose pose is the frame
};

struct BundleContext {
  const std::vector<Camera>& cameras;
  const RegisterViewsOptions& options;

  const Camera& CameraOf(const BundleView& view) const {
    return cameras[static_cast<std::size_t>(view.camera)];
  }
};

// Minimises over the active views' poses, the tags, the points that two active views see, and the size error.
// Sets converged, message, cost, scale, reduced_chi2 and point_sigma_px.
void SolveBundle(const BundleContext& context, BundleAdjustment& adjustment);

// Sets scale, reduced_chi2 and point_sigma_px from the residuals as they are.
void RescaleBundle(const BundleContext& context, BundleAdjustment& adjustment);

// Marks the points in use. Points that fewer than two active views use have no place, so their observations
// do not count.
std::vector<bool> UsedPoints(const BundleAdjustment& adjustment);

// Returns a tag's corners after the adjustment, in world, m.
std::array<Eigen::Vector3d, 4> AdjustedCorners(const BundleAdjustment& adjustment, const TagObservation& tag);

struct BundleCornerError {
  Eigen::Vector2d error_px;
  double sigmas = 0;  // |error_px| / sigma_px
};
// Return the errors of one tag's corners, or of all used corners of a view.
std::vector<BundleCornerError> BundleTagErrors(const BundleContext& context,
                                               const BundleAdjustment& adjustment, const BundleView& view,
                                               std::size_t tag_index);
std::vector<BundleCornerError> BundleViewErrors(const BundleContext& context,
                                                const BundleAdjustment& adjustment, const BundleView& view);
// Returns the rms per axis, in sigmas.
double BundleRmsSigmas(const std::vector<BundleCornerError>& errors);

// Returns |Project(point) - pixel|, px; infinity where the point has no image.
double PointErrorPx(const BundleContext& context, const BundleAdjustment& adjustment, const BundleView& view,
                    const PointObservation& observation);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_BUNDLE_BUNDLE_ADJUSTMENT_H_
