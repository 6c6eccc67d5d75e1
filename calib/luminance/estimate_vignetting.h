// Vignetting, and small errors of photos' exposures, from the same surfaces seen at different places of
// different photos; or vignetting from a flat field, which is one surface in one photo.
//
//   ln value_i = s_surface(i) + ln V(r_i) + g_photo(i) + noise,   ln V = k_1 r^2 + k_2 r^4 + ...
//   min over k, g, s of sum rho(residual / sigma_i) + sum (g / gain_prior)^2
//
// Surfaces must be diffuse, so that their luminance is the same from everywhere; rho (Huber at 2.5) leaves
// room for some that are not. The luminances s are eliminated: the system has as many unknowns as the
// polynomial has terms and there are photos.
//
// Gauge: V = 1 at the centre; a factor common to all photos belongs to the surfaces, and the prior holds the
// gains about zero. The order (0: no vignetting) is the simplest that is worse than the best on held-out
// surfaces by no more than that difference's standard error.
//
// Throws std::invalid_argument for photos out of range, values or sigmas that are not finite and > 0.
// Source: Goldman (2010), sec. 3, with known exposures; Litvinov and Schechner (2005), eq. 7 (logarithms).
#ifndef LUXFIT_CALIB_LUMINANCE_ESTIMATE_VIGNETTING_H_
#define LUXFIT_CALIB_LUMINANCE_ESTIMATE_VIGNETTING_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/luminance/luminance.h"
#include "calib/luminance/vignetting.h"

namespace luxfit {

struct VignettingSample {
  int photo = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  int surface = 0;  // samples of one number show the same luminance
  double value = 0;
  double relative_sigma = 0.01;
};

struct VignettingOptions {
  int max_order = 3;
  double gain_prior = 0.01;        // sigma of ln exposure; 0: exposures are exact
  double max_corner_sigma = 0.03;  // of ln V at r = 1: beyond it the samples do not determine V
};

struct VignettingEstimate {
  bool is_determined = false;
  std::string message;  // why not
  Vignetting vignetting;
  Eigen::VectorXd log_gain;            // one a photo: exposure = stated * exp(log_gain)
  double corner_sigma = 0;             // of ln V at r = 1
  double residual_rms = 0;             // of ln value, robust
  std::vector<double> held_out_error;  // mean robust squared residual of each order from 0
};

// `none`: centre and radius (NoVignetting).
VignettingEstimate EstimateVignetting(const std::vector<VignettingSample>& samples, int photos,
                                      const Vignetting& none, const VignettingOptions& options = {});

// A photo of an evenly bright surface that fills the picture: cells of a grid of 32 x 32 as samples.
VignettingEstimate VignettingOfFlatField(const LuminanceImage& flat_field,
                                         const VignettingOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_ESTIMATE_VIGNETTING_H_
