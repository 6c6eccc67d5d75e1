// Draws the reprojection errors of a camera's corners: as vectors over the image, and as a histogram.
//
//   vector: from where the corner was seen, magnified, along predicted - seen
//   histogram: both components of the corners in use, beside the normal curve of the noise
//
// The magnification is a round number at which nine tenths of the vectors are shorter than 8 % of the image's
// width. Outliers are crosses. A residual that is not finite has no vector.
#ifndef LUXFIT_APPS_CHARTS_RESIDUAL_SVG_H_
#define LUXFIT_APPS_CHARTS_RESIDUAL_SVG_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/charts/image_frame.h"

namespace luxfit {

struct SeenCorner {
  Eigen::Vector2d pixel, residual_px;  // predicted - seen
  bool is_outlier = false;
};

// Returns by how much vectors are drawn longer than they are; 1 without corners in use.
double ResidualMagnification(const ImageFrame& frame, const std::vector<SeenCorner>& corners);

std::string ResidualVectorsSvg(const ImageFrame& frame, const std::vector<SeenCorner>& corners);

// `noise_px`: sigma of the curve, per axis. Returns an empty text where no corner is in use or there is no
// noise.
std::string ResidualHistogramSvg(const std::vector<SeenCorner>& corners, double noise_px);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_RESIDUAL_SVG_H_
