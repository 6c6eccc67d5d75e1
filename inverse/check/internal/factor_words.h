// Says what would multiply a reading by a factor: a unit, or a decimal point.
#ifndef LUXFIT_INVERSE_CHECK_INTERNAL_FACTOR_WORDS_H_
#define LUXFIT_INVERSE_CHECK_INTERNAL_FACTOR_WORDS_H_

#include <optional>
#include <string>

namespace luxfit {

struct KnownFactor {
  double factor = 1;
  std::string words;  // a clause such as "as in foot-candles"
};
// `factor`: what is given over what is right, known to 3 %. Returns nothing where no cause is known.
std::optional<KnownFactor> FindKnownFactor(double factor);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHECK_INTERNAL_FACTOR_WORDS_H_
