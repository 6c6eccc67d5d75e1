// Several exposures of one pose and one state of the light, merged.
//
//   Y_c = sum_i w_i Y_ci / sum_i w_i,   w_i = t_i^2 / sigma_c^2(Y_c t_i),   var(Y_c) = 1 / sum_i w_i
//
// Y_ci: channel c of exposure i (luminance.h), t_i: its relative exposure, sigma^2: the noise of a count
// (sensor_noise.h), through the slope of the response where there is one, or
// the relative sigma that it states. The noise is that of the expected
// count, from what has been merged before: a weight that followed the pixel's own noise would favour low
// counts. Saturated pixels and their margin are left out, exposure by exposure; dark ones are kept in linear
// photos (leaving out those below a limit would favour high counts) and left out with a response, which is
// not known there.
//
// A pixel is saturated where every exposure is, and valid where the merged luminance lies above the dark
// limit of its longest exposure that is not saturated.
//
// A class because exposures come one by one: only the sums are kept, not the photos.
// Source: Hasinoff, Durand, Freeman (2010), eq. 3 (inverse-variance weights); Debevec and Malik (1997),
// eq. 6.
#ifndef LUXFIT_CALIB_LUMINANCE_BRACKET_H_
#define LUXFIT_CALIB_LUMINANCE_BRACKET_H_

#include <array>
#include <utility>

#include "calib/luminance/luminance.h"

namespace luxfit {

class BracketMerger {
 public:
  // `options.noise`: of a count; DefaultNoise of the first photo where empty.
  explicit BracketMerger(LuminanceOptions options) : options_(std::move(options)) {}

  // Longest exposure first. Throws std::invalid_argument where they do not descend, where sizes differ, and
  // as ToRelativeLuminance.
  void Add(const Photo& photo, double exposure_s);

  // Throws std::invalid_argument where nothing was added.
  LuminanceImage Merged() const;

 private:
  void AddChannel(size_t channel, const Photo& photo, const ImagePlane& relative, const PixelMask& used,
                  double exposure_s);

  LuminanceOptions options_;
  double last_exposure_s_ = 0;  // 0: nothing added
  std::array<ImagePlane, 3> weight_sum_, weighted_sum_;
  ImagePlane dark_limit_;  // of the longest unsaturated exposure; 0: none yet
  PixelMask saturated_;
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_BRACKET_H_
