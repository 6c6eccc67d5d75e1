// Finds the median of weighted numbers: the value below which half of the weight lies. NaN for no numbers.
#ifndef LUXFIT_CALIB_LUMINANCE_WEIGHTED_MEDIAN_H_
#define LUXFIT_CALIB_LUMINANCE_WEIGHTED_MEDIAN_H_

#include <utility>
#include <vector>

namespace luxfit {

double WeightedMedian(std::vector<std::pair<double, double>> value_and_weight);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_LUMINANCE_WEIGHTED_MEDIAN_H_
