// Returns the scale of absolute luminance from a surface whose luminance was measured.
//
//   cdm2_per_count_s = L / (mean Y * range_counts),   L = cdm2_per_count_s * range_counts * Y
//
// Y: mean relative luminance of the surface's pixels (luminance.h); range_counts: full scale less black. The
// relative sigma is that of L and of the mean together. (A luxmeter reading fixes the scale in the fit
// instead.)
//
// Empty where the patch has fewer than 10 pixels, or fewer than nine tenths of them are valid: saturated or
// dark ones would bias the mean. Throws std::invalid_argument for sizes that differ, a luminance or range
// that is not > 0 and a sigma < 0.
#ifndef LUXFIT_CALIB_LUMINANCE_INTERNAL_KNOWN_LUMINANCE_H_
#define LUXFIT_CALIB_LUMINANCE_INTERNAL_KNOWN_LUMINANCE_H_

#include <optional>

#include "calib/luminance/luminance.h"

namespace luxfit {

struct LuminanceScale {
  double cdm2_per_count_s = 0;
  double relative_sigma = 0;
};

// `patch`: true at the surface's pixels.
std::optional<LuminanceScale> ScaleFromKnownLuminance(const LuminanceImage& image, const PixelMask& patch,
                                                      double luminance_cd_m2, double relative_sigma,
                                                      double range_counts);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_INTERNAL_KNOWN_LUMINANCE_H_
