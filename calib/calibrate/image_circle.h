// Finds the part of a wide camera's image in which its lens gives an image at all: its image circle.
//
//   circle = { pixel : |pixel - (cx, cy)| <= radius }
//
// A camera whose picture reaches no more than 60 degrees from the axis has no circle: all of its picture is seen. A wider
// one has the larger of these radii:
//   1. that of the outermost corner, since what shows a corner is seen;
//   2. where the photos turn dark: the first ring beyond the corners of which less than a quarter is lit in any photo.
//      Photos that are lit everywhere have no circle. Where no photos are known, that of 90 degrees from the axis,
//      where the lens has an image of them.
//   3. that of 60 degrees from the axis: boards before a black wall are no reason to judge less.
// A ring, and not a pixel, decides, so that stamped dates or dark furniture do not.
//
// Dark: within 6 % of the way from the darkest to the brightest display value, and below a quarter of the brightest one: a
// lens that darkens towards the rim is lit there.
#ifndef LUXFIT_CALIB_CALIBRATE_IMAGE_CIRCLE_H_
#define LUXFIT_CALIB_CALIBRATE_IMAGE_CIRCLE_H_

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "calib/lens/camera.h"
#include "calib/photo_files/image.h"

namespace luxfit {

struct ImageCircle {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double radius_px = std::numeric_limits<double>::infinity();  // infinity: the whole picture
  bool IsWholePicture() const;
  bool Holds(const Eigen::Vector2d& pixel) const;
};

// Holds cells over an image, rows from the top.
struct ImageRaster {
  int width_px = 0, height_px = 0;  // of the image
  Eigen::Index rows = 0, columns = 0;
  Eigen::Vector2d MiddleOf(Eigen::Index row, Eigen::Index column) const;  // px
};

// Returns the raster's values, NaN in cells whose middle lies outside the circle.
Eigen::MatrixXd WithinCircle(const ImageCircle& circle, int width_px, int height_px, Eigen::MatrixXd values);

// Returns the mean display value, about 0..1, in cells over a photo's grey counts: 96 columns.
Eigen::MatrixXd DisplayValues(const ImagePlane& grey_counts, double full_scale_counts, bool is_linear);

// `corners_px`: those in use. `brightest`: the largest of the DisplayValues of all photos of the camera; empty: not known.
ImageCircle CircleOf(const Camera& camera, const std::vector<Eigen::Vector2d>& corners_px,
                     const Eigen::MatrixXd& brightest);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_CALIBRATE_IMAGE_CIRCLE_H_
