// The direction to a distant light from its highlight on a mirror sphere.
//
//   n = ((u - u0) / R, -(v - v0) / R, sqrt(1 - ...)),   l = 2 (n . z) n - z,   z = (0, 0, 1) to the camera
//
// Frame: x right, y up, z towards the camera; orthographic. Pixels: (0, 0) is the centre of the top-left one.
// Sources: Chen, Goldman, Seitz (2011), "Photometric stereo with mirror spheres" (the usual arrangement);
// reflection at a sphere.
#ifndef LUXFIT_INVERSE_ALBEDO_MIRROR_SPHERE_H_
#define LUXFIT_INVERSE_ALBEDO_MIRROR_SPHERE_H_

#include <Eigen/Core>
#include <optional>
#include <string>

#include "calib/luminance/image.h"
#include "calib/luminance/luminance.h"

namespace luxfit {

struct SphereCircle {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double radius_px = 0;
  std::string message;  // why the mask is not taken for a whole circle; empty: it is one
  bool IsUsable() const { return message.empty(); }
};

// From the area and the centroid of the mask's pixels; a whole circle has the second moments R^2 / 4 too.
SphereCircle CircleOfMask(const PixelMask& mask);

// The outward normal of a sphere at a pixel; none outside the circle.
std::optional<Eigen::Vector3d> SphereNormal(const SphereCircle& circle, const Eigen::Vector2d& pixel);

struct MirrorDirection {
  Eigen::Vector3d to_light = Eigen::Vector3d::UnitZ();
  double sigma_rad = 0;  // half a pixel of the highlight's centroid and of the circle each
  std::string message;   // why there is none; empty: found
  bool IsUsable() const { return message.empty(); }
};

// The centroid of the brightest connected area in the circle: pixels above `share` of the brightest.
MirrorDirection LightOnMirrorSphere(const ImagePlane& image, const SphereCircle& circle, double share = 0.8);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ALBEDO_MIRROR_SPHERE_H_
