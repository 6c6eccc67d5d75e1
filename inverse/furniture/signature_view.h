// Makes a small undistorted picture of what a view shows in every state, to compare places between views.
//
//   ln Y_s(p) = ln mean of Y_s over the pixels that one pixel p of the picture covers       s: state
//
// A matt place has the same luminance from everywhere, in each state. Its luminances in all states are its
// signature: two views show the same place only where the signatures agree, whatever its paint and its light.
// The picture is a pinhole's, with the camera's focal length and principal point at its own size, at most
// kSignatureWidthPx wide. Pixels that are saturated or too dark in a state are NaN there.
// Source: own; agreement of views at swept planes: Collins (1996), "A space-sweep approach to true multi-image
// matching".
#ifndef LUXFIT_INVERSE_FURNITURE_SIGNATURE_VIEW_H_
#define LUXFIT_INVERSE_FURNITURE_SIGNATURE_VIEW_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/luminance/luminance.h"

namespace luxfit {

constexpr int kSignatureWidthPx = 480;

struct SignatureView {
  Eigen::Isometry3d cam_from_world = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d pixel_from_ray = Eigen::Matrix3d::Identity();  // of the pinhole
  // Covariance of the pose as in RegisteredView: (rotation vector in world axes rad, eye in world m).
  Eigen::Matrix<double, 6, 6> pose_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  int camera = 0;  // views of one share its vignetting
  int width_px = 0, height_px = 0, states = 0;
  std::vector<float> log_luminance;  // height x width x states
  std::vector<float> variance;       // of log_luminance, by the photos' noise

  Eigen::Vector3d Eye() const { return cam_from_world.inverse().translation(); }
};

// `photos`: of one pose, by state; null where there is none. The caller sets the camera's number, and the pose's covariance where it is known.
SignatureView MakeSignatureView(const Camera& camera, const Eigen::Isometry3d& cam_from_world,
                                const std::vector<const LuminanceImage*>& photos);

// Returns the pixel of a place; NaN where the view does not show it a pixel within its edges.
Eigen::Vector2d PixelOf(const SignatureView& view, const Eigen::Vector3d& p_in_world);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_SIGNATURE_VIEW_H_
