// Draws the uncertainty of a calibrated camera as SVG: a heat map of the sigma of projections over the image,
// with the corners that it was calibrated from.
//
// Colours are logarithmic from 0.01 to 10 px. Cells without information are hatched, and
// what lies outside the image circle is left blank.
#ifndef LUXFIT_APPS_CHARTS_UNCERTAINTY_SVG_H_
#define LUXFIT_APPS_CHARTS_UNCERTAINTY_SVG_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/calibrate/image_circle.h"

namespace luxfit {

struct MappedCorner {
  Eigen::Vector2d pixel;
  bool is_outlier = false;
};

struct UncertaintyMap {
  std::string title, subtitle;      // above the map; no room is left for an empty title
  int width_px = 0, height_px = 0;  // of the image
  Eigen::MatrixXd sigma_px;         // a raster of cells over the image, rows from the top; NaN: not known
  ImageCircle circle;
  double drawn_px = 720;  // width at which the image is drawn
};

std::string UncertaintySvg(const UncertaintyMap& map, const std::vector<MappedCorner>& corners);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_UNCERTAINTY_SVG_H_
