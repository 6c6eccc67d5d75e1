// Says what would multiply a reading by a factor: a unit, or a decimal point.
#ifndef LUXFIT_INVERSE_CHECK_INTERNAL_FACTOR_WORDS_H_
#define LUXFIT_INVERSE_CHECK_INTERNAL_FACTOR_WORDS_H_

#include <string>

namespace luxfit {

// `factor`: what is given over what is right, known to 3 %. Returns a clause such as "as in foot-candles"; empty where
// no cause is known.
std::string FactorWords(double factor);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_INTERNAL_FACTOR_WORDS_H_
