// Draws the uncertainty of a calibrated camera as SVG: a heat map of the sigma of directions over the image,
// with the corners that it was calibrated from.
//
// Colours are logarithmic from 0.01 to 10 px. Cells without information are hatched.
#ifndef LUXFIT_APPS_CHARTS_UNCERTAINTY_SVG_H_
#define LUXFIT_APPS_CHARTS_UNCERTAINTY_SVG_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/calibrate/calibration.h"

namespace luxfit {

struct MappedCorner {
  Eigen::Vector2d pixel;
  bool is_outlier = false;
};

std::string UncertaintySvg(const CalibratedCamera& camera, const std::vector<MappedCorner>& corners);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_UNCERTAINTY_SVG_H_
