// Models the light that a lens loses towards the corners. Estimates it, and small errors of photos'
// exposures, from surfaces seen at different places of photos.
//
//   ln V(r) = k_1 r^2 + k_2 r^4 + ...,   r = |pixel - centre| / radius        V = 1 at the centre
//
// The even polynomial is that of the logarithm: V stays positive. Its coefficients enter linearly beside the
// logarithms of surfaces' luminance and photos' gains.
//
// Surfaces determine it:
//   ln value_i = s_surface(i) + ln V(r_i) + g_photo(i) + noise
//   min over k, g, s of sum rho(residual / sigma_i) + sum (g / gain_prior)^2
//
// A flat field also determines vignetting: it is one surface in one photo.
//
// Surfaces must be diffuse, so that their luminance is the same from everywhere; rho (Huber at 2.5) tolerates
// some that are not. The luminances s are eliminated: the system has as many unknowns as the polynomial has
// terms and there are photos.
//
// Gauge: V = 1 at the centre. A factor common to all photos belongs to the surfaces, and the prior holds the
// gains near zero. The order (0: no vignetting) is the simplest that held-out surfaces support: worse than
// the best by no more than that difference's standard error.
//
// Throws std::invalid_argument for photos out of range, values or sigmas that are not finite and > 0.
// Source: Goldman, "Vignette and exposure calibration and compensation" (2010), eq. 1 (there of V itself) and
// sec. 3, with known exposures; Litvinov and Schechner (2005), eq. 7 (logarithms).
#ifndef LUXFIT_CALIB_LUMINANCE_VIGNETTING_H_
#define LUXFIT_CALIB_LUMINANCE_VIGNETTING_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/photo_files/image.h"

namespace luxfit {

struct LuminanceImage;  // calib/luminance/luminance.h

struct Vignetting {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double radius_px = 1;          // where r = 1: half the image's diagonal
  Eigen::VectorXd coefficients;  // k_1, k_2, ...; none: V = 1

  double At(const Eigen::Vector2d& pixel) const;
  double Radius2At(const Eigen::Vector2d& pixel) const;  // r^2
};

// Returns V = 1 with the centre and radius of an image of that size.
Vignetting NoVignetting(int width_px, int height_px);

// Returns V at every pixel, height x width.
ImagePlane VignettingImage(const Vignetting& vignetting, int width_px, int height_px);

struct VignettingSample {
  int photo = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  int surface = 0;  // samples with the same number show the same luminance
  double value = 0;
  double relative_sigma = 0.01;
};

struct VignettingOptions {
  int max_order = 3;
  double gain_prior = 0.01;        // sigma of ln exposure; 0: exposures are exact
  double max_corner_sigma = 0.03;  // in ln V at r = 1: beyond it the samples do not determine V
};

struct VignettingEstimate {
  bool is_determined = false;
  std::string message;  // says why V is not determined
  Vignetting vignetting;
  Eigen::VectorXd log_gain;  // one for each photo: exposure = stated * exp(log_gain)
  double corner_sigma = 0;   // in ln V at r = 1
  double residual_rms = 0;   // in ln value, robust
};

// Estimates V from samples. `none` gives the centre and radius (NoVignetting).
VignettingEstimate EstimateVignetting(const std::vector<VignettingSample>& samples, int photos,
                                      const Vignetting& none, const VignettingOptions& options = {});

// Estimates V from a photo of an evenly bright surface that fills the picture. Samples are the cells of a 32
// x 32 grid.
VignettingEstimate VignettingOfFlatField(const LuminanceImage& flat_field,
                                         const VignettingOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_VIGNETTING_H_
