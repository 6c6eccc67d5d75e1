// Models the noise of a count, as a share of full scale x = (count - black) / (full scale - black).
//
//   sigma^2(x) = read^2 + shot x
//
// read: read noise and quantisation; shot: the counts of one electron, 1 / full well. Two exposures of one
// pose determine the model, since their difference shows noise and nothing of the scene:
//
//   var(x_1 / t_1 - x_2 / t_2) = sigma^2(x_1) / t_1^2 + sigma^2(x_2) / t_2^2
//
// The pairs are divided into bins of luminance. The variance of each bin comes from the median absolute
// deviation of that difference about its median. Weighted non-negative least squares gives both parameters.
//
// Assumes counts that were not clipped at black. Files whose black level was subtracted and cut off at zero
// have lost half of their noise in the dark.
//
// Source: EMVA 1288, sec. 2; Hasinoff, Durand, Freeman, "Noise-optimal capture for high dynamic range
// photography" (2010), eq. 2.
#ifndef LUXFIT_CALIB_LUMINANCE_SENSOR_NOISE_H_
#define LUXFIT_CALIB_LUMINANCE_SENSOR_NOISE_H_

#include <optional>
#include <vector>

#include "calib/luminance/image.h"

namespace luxfit {

struct SensorNoise {
  // Defaults: a plain sensor, full well 20 000 electrons, read noise and quantisation of 4 electrons.
  double read = 2e-4;
  double shot = 5e-5;

  double Variance(double share_of_full_scale) const {
    return read * read + shot * (share_of_full_scale > 0 ? share_of_full_scale : 0);
  }
};

// Returns the noise to assume where none was estimated. 8 bits round to 1 / 255 of full scale, and lossy
// files to more, so no electron shows.
SensorNoise DefaultNoise(int bits_per_channel);

// Holds one pixel of two exposures, as shares of full scale.
struct NoisePair {
  float first = 0, second = 0;
};

// Estimates the noise from pairs. Empty where fewer than 2000 pairs are given, or luminance does not vary
// enough to determine it. Throws std::invalid_argument where an exposure is not > 0.
std::optional<SensorNoise> EstimateNoise(const std::vector<NoisePair>& pairs, double first_exposure,
                                         double second_exposure);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_SENSOR_NOISE_H_
