// Samples a plane bilinearly; pixel (0, 0) is the centre of the top-left pixel.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_PLANE_SAMPLE_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_PLANE_SAMPLE_H_

#include <Eigen/Core>

#include "calib/photo_files/image.h"

namespace luxfit {

// Returns the sample; NaN outside the plane, at pixels that are NaN, and for a place that is NaN.
double SampleBilinear(const ImagePlane& plane, const Eigen::Vector2d& pixel);

// Returns whether every pixel of the square of that half-width about `pixel` lies in the plane.
bool Holds(const ImagePlane& plane, const Eigen::Vector2d& pixel, double half_width_px);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_PLANE_SAMPLE_H_
