// The median of some numbers: the middle one of an odd count, the mean of the middle two of an even one; NaN
// of none.
#ifndef LUXFIT_CALIB_LUMINANCE_MEDIAN_H_
#define LUXFIT_CALIB_LUMINANCE_MEDIAN_H_

#include <vector>

namespace luxfit {

// Of a Gaussian, its standard deviation to the median of absolute deviations.
inline constexpr double kSigmaPerMad = 1.4826;

double Median(std::vector<double> values);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_MEDIAN_H_
