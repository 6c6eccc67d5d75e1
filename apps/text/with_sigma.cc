#include "apps/text/with_sigma.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace luxfit {

std::string WithSigma(double value, double sigma) {
  if (!(sigma > 0)) return fmt::format("{:.6g} ± ?", value);
  constexpr int kMostDecimals = 9;
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, kMostDecimals);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, sigma, decimals);
}

}  // namespace luxfit
