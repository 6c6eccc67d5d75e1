// Draws where corners fell in a camera's image: the corners, and how many each cell of a raster holds.
//
// Cells are the darker the more corners they hold. Cells without a corner are hatched in red, unless their
// middle lies outside the image circle.
#ifndef LUXFIT_APPS_CHARTS_COVERAGE_SVG_H_
#define LUXFIT_APPS_CHARTS_COVERAGE_SVG_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/charts/image_frame.h"
#include "calib/calibrate/image_circle.h"

namespace luxfit {

// `counts`: corners by cell over the image, rows from the top.
std::string CoverageSvg(const ImageFrame& frame, const Eigen::MatrixXi& counts, const ImageCircle& circle,
                        const std::vector<Eigen::Vector2d>& corners);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_COVERAGE_SVG_H_
