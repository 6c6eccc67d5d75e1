// Converts counts to relative luminance.
//
//   Y = w_r R + w_g G + w_b B,   R, G, B = (counts - black) / (full_scale - black) / exposure_s
//   L = cdm2_per_count_s * (full_scale - black) * Y,   cd/m2
//
// With a response, R, G, B = f_c(counts) / exposure_s instead (response.h). `exposure_s` may be a relative
// exposure: time * iso / f-number^2, up to a constant that all photos of a camera share. Where the noise of a
// count is known, every pixel has its variance.
//
// Pixels at or above the saturation level are not valid, nor are their neighbours: a saturated pixel may have
// bled or been resampled. Pixels below the dark limit are not valid either. Float files have no quantisation:
// there only counts at or below black are dark.
// Source: the luminance weights of the session format, 0.265 R + 0.670 G + 0.065 B.
#ifndef LUXFIT_CALIB_LUMINANCE_LUMINANCE_H_
#define LUXFIT_CALIB_LUMINANCE_LUMINANCE_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "calib/luminance/response.h"
#include "calib/luminance/vignetting.h"
#include "calib/photo_files/image.h"

namespace luxfit {

// Models the noise of a count, as a share of full scale x = (count - black) / (full scale - black).
//
//   sigma^2(x) = read^2 + shot x
//
// read: read noise and quantisation; shot: the counts of one electron, 1 / full well. Source: EMVA 1288, sec. 2;
// Hasinoff, Durand, Freeman (2010), "Noise-optimal capture for high dynamic range photography", eq. 2.
struct SensorNoise {
  // Defaults: a plain sensor, full well 20 000 electrons, read noise and quantisation of 4 electrons.
  double read = 2e-4;
  double shot = 5e-5;

  double Variance(double share_of_full_scale) const {
    return read * read + shot * (share_of_full_scale > 0 ? share_of_full_scale : 0);
  }
};

// Returns the noise to assume for counts of so many bits. 8 bits round to 1 / 255 of full scale, and lossy
// files to more, so no electron shows.
SensorNoise DefaultNoise(int bits_per_channel);

struct LuminanceOptions {
  Eigen::Vector3d weights{0.265, 0.670, 0.065};
  double black_level_counts = 0;
  double saturation_fraction = 0.97;  // share of full scale; sensors become nonlinear before they clip
  double dark_fraction = 2e-4;        // share of full scale: below it quantisation and read noise dominate
  int saturation_margin_px = 2;       // margin of neighbours of saturated pixels that is left out
  std::optional<CameraResponse> response;  // empty: linear
  double dark_response_fraction = 0.02;    // share of full scale: below it a response is unreliable
  std::optional<SensorNoise> noise;        // empty: no variance
};

struct LuminanceImage {
  std::array<ImagePlane, 3> relative_rgb;  // the channels in the same unit: Y is their weighted sum
  ImagePlane relative_luminance;           // per second of exposure, full scale = 1 at 1 s
  ImagePlane variance;  // variance of relative_luminance, from the counts' noise; empty: unknown
  PixelMask valid;
  PixelMask saturated;  // with its margin; other pixels that are not valid are too dark
};

// Returns the relative luminance of a photo. Throws std::invalid_argument where exposure_s is not positive or
// the photo is empty. Throws it also for a response with a photo of floats, which has no counts.
LuminanceImage ToRelativeLuminance(const Photo& photo, double exposure_s,
                                   const LuminanceOptions& options = {});

// Returns the image divided by V at every pixel, with its variance divided by V^2.
LuminanceImage WithoutVignetting(LuminanceImage image, const Vignetting& vignetting);

// Corrects one photo for errors that surfaces seen by several photos revealed:
//
//   ln Y -> ln Y + q ln(Y t) - g - a_1 r^2 - a_2 r^4 - ...
//
// t: exposure, r: distance from the image's centre over half its diagonal (calib/luminance/vignetting.h).
struct PhotoCorrection {
  double log_gain = 0;             // g = ln(true exposure / stated)
  std::vector<double> vignetting;  // a_1, a_2, ...
  double exponent = 0;             // q: counts go with light to the power 1 / (1 + q)

  // Returns the logarithm of the factor for Y. `log_share`: ln(Y t); `radius2`: r^2.
  double LogFactor(double log_share, double radius2) const;
};
// Returns the corrected image of a photo of exposure t. Pixels that are not positive stay as they are.
LuminanceImage WithCorrection(LuminanceImage image, const PhotoCorrection& correction, double exposure_s);

// Returns the light of `image` beyond a share of that of `ambient`, the same view without that light. Channels are
// subtracted and variances added. A pixel is valid where it is valid in `image` and not saturated in
// `ambient`.
// Throws std::invalid_argument for images of different sizes.
LuminanceImage WithoutAmbient(LuminanceImage image, const LuminanceImage& ambient, double share = 1);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_LUMINANCE_H_
