// Writes a value with its standard uncertainty: "0.08343 ± 0.00006".
//
// The sigma has two digits, and the value as many decimals. A sigma that is not known (NaN) or is 0 is
// written as "?", and the value with six digits.
#ifndef LUXFIT_APPS_TEXT_WITH_SIGMA_H_
#define LUXFIT_APPS_TEXT_WITH_SIGMA_H_

#include <string>

namespace luxfit {

std::string WithSigma(double value, double sigma);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_WITH_SIGMA_H_
