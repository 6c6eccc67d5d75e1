#include "forward/luminaire/internal/photometry_planes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

constexpr int kResampleCDeg = 5, kResampleGammaDeg = 1;  // no coarser than what goniophotometers give

std::vector<double> DegFromRad(const std::vector<double>& rad) {
  std::vector<double> deg;
  deg.reserve(rad.size());
  // Rounded to what was in the file before it was turned into rad.
  for (const double r : rad) deg.push_back(std::round(r * 180 / M_PI * 1e9) / 1e9);
  return deg;
}

bool IsWholeCircle(const IntensityTable& table) {
  return table.table_from_luminaire.isIdentity() && std::abs(table.c_rad.front()) < 1e-9 &&
         std::abs(table.c_rad.back() - 2 * M_PI) < 1e-9;
}

bool IsRotational(const IntensityTable& table) {
  const size_t n = table.gamma_rad.size();
  for (size_t i = n; i < table.cd_per_lm.size(); ++i) {
    if (table.cd_per_lm[i] != table.cd_per_lm[i - n]) return false;
  }
  return true;
}

}  // namespace

std::vector<double> RadFromDeg(const std::vector<double>& deg) {
  std::vector<double> rad;
  rad.reserve(deg.size());
  for (const double d : deg) rad.push_back(d * M_PI / 180);
  return rad;
}

PhotometryFile WithTable(PhotometryFile file, const IntensityTable& table_cd, const std::string& name) {
  file.luminaire_flux_lm = FluxIntegral(table_cd);
  if (!(file.luminaire_flux_lm > 0))
    throw std::runtime_error(name +
                             ": intensities: expected light over some solid angle, got a flux of 0 lm; the "
                             "angles or the intensities are wrong");
  file.table = Normalized(table_cd);
  return file;
}

IntensityTable InLuminaireFrame(const IntensityTable& table) {
  if (table.c_rad.size() < 2) throw std::invalid_argument("InLuminaireFrame: expected a table");
  return IsWholeCircle(table) ? table : Resampled(table, kResampleCDeg, kResampleGammaDeg);
}

PhotometryPlanes PlanesOf(const IntensityTable& given, double scale) {
  const IntensityTable table = InLuminaireFrame(given);
  PhotometryPlanes planes;
  planes.gamma_deg = DegFromRad(table.gamma_rad);
  planes.c_deg = DegFromRad(table.c_rad);
  planes.c_deg.pop_back();
  if (IsRotational(table)) planes.c_deg = {0};
  const size_t count = planes.c_deg.size() * planes.gamma_deg.size();
  for (size_t i = 0; i < count; ++i) planes.intensity.push_back(scale * table.cd_per_lm[i]);
  return planes;
}

}  // namespace luxfit
