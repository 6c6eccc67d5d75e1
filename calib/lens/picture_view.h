// Lays a photo out as the picture of an ideal lens: a pinhole, or an angular (equidistant) fisheye.
//
//   pixel = f (a, b) + ((width - 1) / 2, (height - 1) / 2)                        px
//   kPerspective   (a, b) = (X, Y) / Z,                          angle across = 2 atan(size / (2 f))
//   kAngular       (a, b) = theta (X, Y) / sqrt(X^2 + Y^2),      angle across = size / f
//
// theta is the angle from the lens's axis, rad; (X, Y, Z) a direction in the camera frame (x right, y down, z
// forward). f is the photo's focal length along x: at the centre a pixel of the picture is as large as one of
// the photo. The picture is symmetric about the axis and as large as the photo fills. What lies behind the
// plane of the lens (theta > 90 degrees) is left out.
//
// Source: Radiance, rpict(1), view types -vtv and -vta; Kannala and Brandt (2006), eq. 3 (equidistant).
#ifndef LUXFIT_CALIB_LENS_PICTURE_VIEW_H_
#define LUXFIT_CALIB_LENS_PICTURE_VIEW_H_

#include <Eigen/Core>

#include "calib/lens/camera.h"
#include "calib/photo_files/image.h"

namespace luxfit {

enum class PictureProjection { kPerspective, kAngular };

struct PictureView {
  PictureProjection projection = PictureProjection::kPerspective;
  int width_px = 0;
  int height_px = 0;
  double focal_px = 0;
};

// Returns the largest picture that the photo fills: a pinhole's where every corner of the photo is within 60
// degrees of the axis, since farther out a pinhole's pixels stretch by more than four, else an angular fisheye's.
PictureView PictureViewOf(const Camera& camera);

// Returns the angle that so many pixels span, rad.
double AngleAcross(const PictureView& view, int size_px);

// Returns the unit direction of a pixel in the camera frame; NaN for theta > 90 degrees.
Eigen::Vector3d DirectionOf(const PictureView& view, const Eigen::Vector2d& pixel);

// 2 x pixels, row by row: where the photo shows what each pixel of a picture shows, px.
using PhotoPlaces = Eigen::Matrix<float, 2, Eigen::Dynamic>;

// Returns these places; NaN where the lens has no image or the photo ends.
PhotoPlaces PlacesInPhoto(const PictureView& view, const Camera& camera);

// Returns a plane of the photo as the picture has it, sampled bilinearly; NaN where the place is.
ImagePlane Resampled(const ImagePlane& photo, const PhotoPlaces& places, const PictureView& view);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LENS_PICTURE_VIEW_H_
