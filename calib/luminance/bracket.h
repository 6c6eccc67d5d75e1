// Merges several exposures of one pose and one state of the light.
//
//   Y_c = sum_i w_i Y_ci / sum_i w_i,   w_i = t_i^2 / sigma_c^2(Y_c t_i),   var(Y_c) = 1 / sum_i w_i
//
// Y_ci: channel c of exposure i (luminance.h); t_i: its relative exposure. sigma^2: the noise of a count
// (SensorNoise), through the slope of the response where there is one, or the relative sigma that the
// response states. The noise is that of the expected count, from the exposures merged so far: a weight that
// followed the pixel's own noise would favour low counts.
//
// Saturated pixels and their margin are left out, exposure by exposure. Dark pixels are kept in linear
// photos, since leaving out those below a limit would favour high counts. With a response they are left out,
// since the response is unknown there.
//
// A pixel is saturated where every exposure is. It is valid where the merged luminance lies above the dark
// limit of its longest exposure that is not saturated.
//
// Exposures come one by one, so this is a class that keeps only the sums and not the photos.
// Source: Hasinoff, Durand, Freeman (2010), eq. 3 (inverse-variance weights); Debevec and Malik (1997), eq.
// 6.
#ifndef LUXFIT_CALIB_LUMINANCE_BRACKET_H_
#define LUXFIT_CALIB_LUMINANCE_BRACKET_H_

#include <array>
#include <utility>

#include "calib/luminance/luminance.h"

namespace luxfit {

class BracketMerger {
 public:
  // `options.noise`: noise of a count; DefaultNoise of the first photo where empty.
  explicit BracketMerger(LuminanceOptions options) : options_(std::move(options)) {}

  // Adds an exposure, the longest first. Throws std::invalid_argument where exposures do not descend, where
  // sizes differ, and as ToRelativeLuminance does.
  void Add(const Photo& photo, double exposure_s);

  // Returns the merged image. Throws std::invalid_argument where nothing was added.
  LuminanceImage Merged() const;

 private:
  void AddChannel(size_t channel, const Photo& photo, const ImagePlane& relative, const PixelMask& used,
                  double exposure_s);

  LuminanceOptions options_;
  double last_exposure_s_ = 0;  // 0: nothing added
  std::array<ImagePlane, 3> weight_sum_, weighted_sum_;
  ImagePlane dark_limit_;  // set by the longest unsaturated exposure; 0: none yet
  PixelMask saturated_;
};

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_BRACKET_H_
