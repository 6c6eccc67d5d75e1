// Counts to relative luminance.
//
//   Y = w_r R + w_g G + w_b B,   R, G, B = (counts - black) / (full_scale - black) / exposure_s
//
// With a response, R, G, B = f_c(counts) / exposure_s in its place (response.h). `exposure_s` may be a
// relative exposure: time * iso / f-number^2, up to a constant that all photos of a camera share. Where the
// noise of a count is known, every pixel has its variance.
//
// Y is proportional to luminance: L = cdm2_per_count_s * (full_scale - black) * Y. Pixels at or above the
// saturation level, their neighbours (a saturated pixel may have bled or been resampled), and those below the
// dark limit are not valid. Float files have no quantisation: there only counts at or below black are dark.
// Source: the luminance weights of the session format, 0.265 R + 0.670 G + 0.065 B.
#ifndef LUXFIT_CALIB_LUMINANCE_LUMINANCE_H_
#define LUXFIT_CALIB_LUMINANCE_LUMINANCE_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "calib/luminance/image.h"
#include "calib/luminance/response.h"
#include "calib/luminance/sensor_noise.h"
#include "calib/luminance/vignetting.h"

namespace luxfit {

using PixelMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // true: usable

struct LuminanceOptions {
  Eigen::Vector3d weights{0.265, 0.670, 0.065};
  double black_level_counts = 0;
  double saturation_fraction = 0.97;       // of full scale; sensors bend before they clip
  double dark_fraction = 2e-4;             // of full scale: below it quantisation and read noise dominate
  int saturation_margin_px = 2;            // neighbours of saturated pixels left out
  std::optional<CameraResponse> response;  // none: linear
  double dark_response_fraction = 0.02;    // of full scale: below it a response is not known well
  std::optional<SensorNoise> noise;        // none: no variance
};

struct LuminanceImage {
  std::array<ImagePlane, 3> relative_rgb;  // the channels in the same unit: Y is their weighted sum
  ImagePlane relative_luminance;           // per second of exposure, full scale = 1 at 1 s
  ImagePlane variance;                     // of relative_luminance, from the counts' noise; empty: not known
  PixelMask valid;
  PixelMask saturated;  // with its margin; what is neither valid nor saturated is too dark
};

// Throws std::invalid_argument if exposure_s is not positive, the photo is empty, or a response is given for
// a photo of floats, which has no counts.
LuminanceImage ToRelativeLuminance(const Photo& photo, double exposure_s,
                                   const LuminanceOptions& options = {});

// Divided by V at every pixel, its variance by V^2.
LuminanceImage WithoutVignetting(LuminanceImage image, const Vignetting& vignetting);

// Light of `image` beyond that of `ambient`, the same view without it: channels subtracted, variances added,
// valid where both are. Throws std::invalid_argument for images of different sizes.
LuminanceImage WithoutAmbient(LuminanceImage image, const LuminanceImage& ambient);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_LUMINANCE_H_
