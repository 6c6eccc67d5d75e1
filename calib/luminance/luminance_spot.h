// Measures the mean luminance of a circle of a photo, as a spot meter does.
//
//   Y = 1/n sum_i Y_i,   sigma^2 = max(s^2, 1/n sum_i var_i) / n
//
// over the n pixels whose centres lie in the circle. s^2: variance of the pixels about their mean, so a pattern in the
// circle counts as well; var_i: variance of a pixel by its counts' noise, where the image has it.
//
// The error of a response is common to all pixels of a circle, and no mean makes it less. Exposures j of a bracket are
// merged by 1 / u_cj^2, and their errors are taken as common too:
//
//   u = sum_c w_c Y_c u_c / sum_c w_c Y_c,   u_c = sum_j 1 / u_cj  /  sum_j 1 / u_cj^2
//
// u_cj: relative sigma of the response of channel c at the count of exposure j (calib/luminance/response.h).
//
// Y is relative luminance (calib/luminance/luminance.h); pixel (0, 0) is the centre of the top-left pixel.
// Source: JCGM 100:2008, 4.2.3 (mean of readings) and 5.2.2 (common errors).
#ifndef LUXFIT_CALIB_LUMINANCE_LUMINANCE_SPOT_H_
#define LUXFIT_CALIB_LUMINANCE_LUMINANCE_SPOT_H_

#include <Eigen/Core>
#include <vector>

#include "calib/luminance/luminance.h"

namespace luxfit {

struct LuminanceSpot {
  int pixels = 0;
  int saturated = 0;  // of these, with the margin of saturated ones
  int dark = 0;       // of these, too dark for a value
  double relative_luminance =
      0;              // mean over all of them: what saturated pixels show is the least that they are
  double spread = 0;  // s
  double sigma = 0;   // of the mean, by noise and spread
  Eigen::Vector3d relative_rgb = Eigen::Vector3d::Zero();  // mean
};

// Returns the spot about a pixel. Throws std::invalid_argument for a circle that is not within the image and for a
// radius below 1 px, which has no spread.
LuminanceSpot MeasureSpot(const LuminanceImage& image, const Eigen::Vector2d& pixel, double radius_px);

// Returns the relative sigma u of a spot by its camera's response; 0 where the response states none.
// `exposures_s`: of the bracket. Exposures whose count lies outside the range that `options` allow are not merged and
// do not count.
double ResponseSigma(const CameraResponse& response, const Eigen::Vector3d& relative_rgb,
                     const std::vector<double>& exposures_s, const LuminanceOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_LUMINANCE_SPOT_H_
