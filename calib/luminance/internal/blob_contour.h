// Traces the outline of a bright blob to a fraction of a pixel.
//
// The chain of the blob's outermost pixels (Suzuki and Abe 1985, in OpenCV) is cut at even distances. At each
// cut, the outline is where the luminance along the chain's normal falls below `level`, interpolated
// bilinearly. Cuts near the photo's edge, and those where the luminance crosses the level nowhere within two
// pixels, give no point: the luminaire may go on there.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_BLOB_CONTOUR_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_BLOB_CONTOUR_H_

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

// `labels`: CV_32S; `box`: the blob's pixels lie in it. Returns up to `points` places, in pixels.
std::vector<Eigen::Vector2d> TraceBlobContour(const ImagePlane& luminance, const cv::Mat& labels,
                                              const cv::Rect& box, int label, float level, int points);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_BLOB_CONTOUR_H_
