// Converts between the units that names of columns end in: x_mm against x_m, illuminance_fc against illuminance_lx.
//
//   1 fc = 1 lm/ft2 = 1 / 0.3048^2 lx,   1 in = 25.4 mm,   1 ft = 304.8 mm
//
// Source: NIST Special Publication 811 (2008), appendix B.8.
#ifndef LUXFIT_APPS_TEXT_FORMATS_UNITS_H_
#define LUXFIT_APPS_TEXT_FORMATS_UNITS_H_

#include <optional>
#include <string>

namespace luxfit {

inline constexpr double kLuxPerFootcandle = 1 / (0.3048 * 0.3048), kLuxPerKilolux = 1000;

// Returns what values named `name` are multiplied by to be those of `wanted`: 0.001 for x_mm and x_m. Nothing where
// the names differ by more than the unit that they end in.
std::optional<double> UnitFactor(const std::string& name, const std::string& wanted);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_UNITS_H_
