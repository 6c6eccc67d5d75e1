#include "inverse/check/internal/factor_words.h"

#include <cmath>
#include <string_view>
#include <utility>

namespace luxfit {

std::optional<KnownFactor> FindKnownFactor(double factor) {
  constexpr double kLuxPerFootCandle = 10.7639, kTolerance = 0.03;
  constexpr std::string_view kPoint = "as by a decimal point, or another range of the meter";
  constexpr std::pair<double, std::string_view> kKnown[] = {
      {1 / kLuxPerFootCandle, "as in foot-candles"},
      {kLuxPerFootCandle, "as if foot-candles had been converted once too often"},
      {0.001, "as in klx"},
      {10, kPoint},
      {0.1, kPoint},
      {100, kPoint},
      {0.01, kPoint},
  };
  for (const auto& [known, words] : kKnown)
    if (std::abs(std::log(factor / known)) < kTolerance) return KnownFactor{known, std::string(words)};
  return std::nullopt;
}

}  // namespace luxfit
