#include "calib/register/millimetres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace luxfit {

std::string Millimetres(double length_m) {
  if (!std::isfinite(length_m)) return "an unknown length";
  const double mm = 1000 * length_m;
  if (mm == 0) return "0 mm";
  constexpr int kMostDecimals = 6;
  const int decimals =
      std::clamp(1 - static_cast<int>(std::floor(std::log10(std::abs(mm)))), 0, kMostDecimals);
  return fmt::format("{:.{}f} mm", mm, decimals);
}

}  // namespace luxfit
