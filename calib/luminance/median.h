// Finds the median and quantiles of numbers. Both are NaN for no numbers.
#ifndef LUXFIT_CALIB_LUMINANCE_MEDIAN_H_
#define LUXFIT_CALIB_LUMINANCE_MEDIAN_H_

#include <vector>

namespace luxfit {

// Ratio of standard deviation to median absolute deviation of a Gaussian.
inline constexpr double kSigmaPerMad = 1.4826;

// Returns the middle number of an odd count, the mean of the middle two of an even one.
double Median(std::vector<double> values);

// Returns the number of rank min(floor(share n), n - 1), from 0, of n sorted numbers: itself one of them, also
// at share 0.5 of an even count. Throws std::invalid_argument where the share is not in [0, 1].
double Quantile(std::vector<double> values, double share);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_MEDIAN_H_
