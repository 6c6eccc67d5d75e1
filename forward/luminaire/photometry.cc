#include "forward/luminaire/photometry.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/room/internal/polar_angle.h"

namespace luxfit {
namespace {

constexpr double kSameAngle = 1e-9;  // rad: rounding of mirrored angles, far below any goniophotometer's step

void ExpectRising(const std::vector<double>& angles, const char* what) {
  for (size_t i = 1; i < angles.size(); ++i) {
    if (!(angles[i] - angles[i - 1] > kSameAngle))
      throw std::invalid_argument(std::string("IntensityTable: expected rising ") + what);
  }
}

void ExpectTable(const std::vector<double>& c_rad, const std::vector<double>& gamma_rad,
                 const std::vector<double>& intensity) {
  if (c_rad.empty() || gamma_rad.size() < 2 || intensity.size() != c_rad.size() * gamma_rad.size())
    throw std::invalid_argument("IntensityTable: expected planes x gamma intensities, two gamma at least");
  ExpectRising(c_rad, "C");
  ExpectRising(gamma_rad, "gamma");
  if (!(gamma_rad.front() >= 0) || !(gamma_rad.back() <= M_PI + kSameAngle))
    throw std::invalid_argument("IntensityTable: expected gamma in [0, pi]");
  for (const double i : intensity) {
    if (!std::isfinite(i) || i < 0)
      throw std::invalid_argument("IntensityTable: expected intensities >= 0, finite");
  }
}

struct Plane {
  double c_rad;
  size_t row;  // of the measured planes
};

// Into [0, 2 pi).
double OnCircle(double c_rad) {
  double wrapped = std::fmod(c_rad, 2 * M_PI);
  if (wrapped < -kSameAngle) wrapped += 2 * M_PI;
  return wrapped < kSameAngle || wrapped > 2 * M_PI - kSameAngle ? 0 : wrapped;
}

std::vector<Plane> PlanesAllRound(const std::vector<double>& c_rad, PlaneSymmetry symmetry) {
  std::vector<Plane> planes;
  const bool across_0 = symmetry == PlaneSymmetry::kC0C180 || symmetry == PlaneSymmetry::kQuadrant;
  const bool across_90 = symmetry == PlaneSymmetry::kC90C270 || symmetry == PlaneSymmetry::kQuadrant;
  for (size_t row = 0; row < c_rad.size(); ++row) {
    const double c = c_rad[row];
    planes.push_back({OnCircle(c), row});
    if (across_0) planes.push_back({OnCircle(-c), row});
    if (across_90) planes.push_back({OnCircle(M_PI - c), row});
    if (across_0 && across_90) planes.push_back({OnCircle(M_PI + c), row});
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.c_rad < b.c_rad; });
  const auto same = [](const Plane& a, const Plane& b) { return b.c_rad - a.c_rad < kSameAngle; };
  planes.erase(std::unique(planes.begin(), planes.end(), same), planes.end());
  planes.push_back({planes.front().c_rad + 2 * M_PI, planes.front().row});
  return planes;
}

// The cell of a rising list that holds x, and how far x lies in it; index -1 outside the list.
struct TableCell {
  std::ptrdiff_t index = -1;
  double share = 0, width = 1;
};

TableCell CellOf(const std::vector<double>& angles, double x) {
  if (std::isnan(x)) return {0, x, 1};
  if (x < angles.front() - kSameAngle || x > angles.back() + kSameAngle) return {};
  // Most tables have even steps: the guess is right at once.
  const auto last = static_cast<std::ptrdiff_t>(angles.size()) - 2;
  const double steps =
      (x - angles.front()) / (angles.back() - angles.front()) * static_cast<double>(last + 1);
  std::ptrdiff_t index = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(steps), 0, last);
  while (index > 0 && x < angles[static_cast<size_t>(index)]) --index;
  while (index < last && x >= angles[static_cast<size_t>(index) + 1]) ++index;
  const double low = angles[static_cast<size_t>(index)], width = angles[static_cast<size_t>(index) + 1] - low;
  return {index, std::clamp((x - low) / width, 0.0, 1.0), width};
}

// In the luminaire's frame.
Eigen::Vector3d DirectionOf(double c_rad, double gamma_rad) {
  return {std::sin(gamma_rad) * std::cos(c_rad), std::sin(gamma_rad) * std::sin(c_rad), -std::cos(gamma_rad)};
}

// Returns whether the table is one plane, repeated after a whole turn.
bool IsOnePlaneAllRound(const IntensityTable& table) {
  return table.c_rad.size() == 2 && table.c_rad.back() - table.c_rad.front() > 2 * M_PI - kSameAngle;
}

// `d`: the direction in the table's frame; `sine`: of its gamma.
TableIntensity TowardsInOnePlane(const IntensityTable& table, const TableCell& g, const Eigen::Vector3d& d,
                                 double sine) {
  const double* at = table.cd_per_lm.data() + g.index;
  TableIntensity result;
  result.cd_per_lm = at[0] + g.share * (at[1] - at[0]);
  if (sine < kSameAngle) return result;
  const double d_gamma = (at[1] - at[0]) / g.width, cot = -d.z() / sine;
  result.d_direction =
      table.table_from_luminaire.transpose() * (d_gamma * Eigen::Vector3d(cot * d.x(), cot * d.y(), sine));
  return result;
}

}  // namespace

IntensityTable ExpandPlanes(const std::vector<double>& c_rad, const std::vector<double>& gamma_rad,
                            const std::vector<double>& intensity, PlaneSymmetry symmetry) {
  ExpectTable(c_rad, gamma_rad, intensity);
  std::vector<Plane> planes;
  if (symmetry == PlaneSymmetry::kRotational) {
    planes = {{0, 0}, {2 * M_PI, 0}};
  } else if (symmetry == PlaneSymmetry::kPartial) {
    for (size_t row = 0; row < c_rad.size(); ++row) planes.push_back({c_rad[row], row});
  } else {
    planes = PlanesAllRound(c_rad, symmetry);
  }
  if (planes.size() < 2 || planes.back().c_rad - planes.front().c_rad > 2 * M_PI + kSameAngle)
    throw std::invalid_argument("IntensityTable: expected two planes or more, within one turn");
  IntensityTable table;
  table.gamma_rad = gamma_rad;
  table.gamma_rad.back() = std::min(gamma_rad.back(), M_PI);
  table.cd_per_lm.reserve(planes.size() * gamma_rad.size());
  for (const Plane& plane : planes) {
    table.c_rad.push_back(plane.c_rad);
    const auto first = intensity.begin() + static_cast<std::ptrdiff_t>(plane.row * gamma_rad.size());
    table.cd_per_lm.insert(table.cd_per_lm.end(), first,
                           first + static_cast<std::ptrdiff_t>(gamma_rad.size()));
  }
  table.peak_cd_per_lm = *std::max_element(table.cd_per_lm.begin(), table.cd_per_lm.end());
  return table;
}

double FluxIntegral(const IntensityTable& table) {
  const size_t n = table.gamma_rad.size();
  double flux = 0, previous = 0;
  for (size_t c = 0; c < table.c_rad.size(); ++c) {
    const double* row = table.cd_per_lm.data() + c * n;
    double plane = 0;
    for (size_t g = 1; g < n; ++g) {
      const double a = table.gamma_rad[g - 1], b = table.gamma_rad[g];
      // The header's closed form without its cancellation: I_a (cos a - cos b) + (I_b - I_a) (sinc - cos b).
      const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
      plane += row[g - 1] * 2 * std::sin(middle) * std::sin(half) +
               (row[g] - row[g - 1]) * (std::cos(middle) * std::sin(half) / half - std::cos(b));
    }
    if (c > 0) flux += 0.5 * (plane + previous) * (table.c_rad[c] - table.c_rad[c - 1]);
    previous = plane;
  }
  return flux;
}

IntensityTable Normalized(const IntensityTable& table) {
  const double flux = FluxIntegral(table);
  if (!(flux > 0) || !std::isfinite(flux))
    throw std::invalid_argument("IntensityTable: expected a flux above 0");
  IntensityTable one = table;
  for (double& i : one.cd_per_lm) i /= flux;
  one.peak_cd_per_lm /= flux;
  return one;
}

bool IsSymmetricAboutAim(const IntensityTable& table) {
  constexpr double kTolerance = 0.01;
  constexpr int kGammas = 36, kTurns = 72;
  for (int g = 1; g < kGammas; ++g) {
    const double gamma = M_PI * g / kGammas;
    double least = table.peak_cd_per_lm, most = 0;
    for (int k = 0; k < kTurns; ++k) {
      const double i = IntensityTowards(table, DirectionOf(2 * M_PI * k / kTurns, gamma)).cd_per_lm;
      least = std::min(least, i);
      most = std::max(most, i);
    }
    if (most - least > kTolerance * table.peak_cd_per_lm) return false;
  }
  return true;
}

TableIntensity IntensityTowards(const IntensityTable& table, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = table.table_from_luminaire * direction;
  const double sine = std::sqrt(d.x() * d.x() + d.y() * d.y());
  const TableCell g = CellOf(table.gamma_rad, PolarAngle(sine, -d.z()));
  if (g.index < 0) return {};
  if (IsOnePlaneAllRound(table)) return TowardsInOnePlane(table, g, d, sine);
  const double first = table.c_rad.front();
  double c_angle = sine > 0 ? std::atan2(d.y(), d.x()) : 0;
  // Rounding must not carry the first plane once round.
  c_angle -= 2 * M_PI * std::floor((c_angle - first + kSameAngle) / (2 * M_PI));
  const TableCell c = CellOf(table.c_rad, c_angle);
  if (c.index < 0) return {};

  const double* low =
      table.cd_per_lm.data() + c.index * static_cast<std::ptrdiff_t>(table.gamma_rad.size()) + g.index;
  const double* high = low + table.gamma_rad.size();
  const double at_low = low[0] + g.share * (low[1] - low[0]);
  const double at_high = high[0] + g.share * (high[1] - high[0]);
  TableIntensity result;
  result.cd_per_lm = at_low + c.share * (at_high - at_low);
  if (sine < kSameAngle) return result;
  const double d_gamma = ((1 - c.share) * (low[1] - low[0]) + c.share * (high[1] - high[0])) / g.width;
  const double d_c = (at_high - at_low) / c.width;
  const double cos_c = d.x() / sine, sin_c = d.y() / sine, cos_gamma = -d.z();
  const Eigen::Vector3d in_table = d_gamma * Eigen::Vector3d(cos_gamma * cos_c, cos_gamma * sin_c, sine) +
                                   d_c / sine * Eigen::Vector3d(-sin_c, cos_c, 0);
  result.d_direction = table.table_from_luminaire.transpose() * in_table;
  return result;
}

bool IsOnePlaneAboutAim(const IntensityTable& table) {
  return IsOnePlaneAllRound(table) && table.table_from_luminaire.isIdentity(0);
}

PlaneIntensity IntensityInOnePlane(const IntensityTable& table, double cosine_gamma) {
  const double sine2 = 1 - cosine_gamma * cosine_gamma;
  const double sine = sine2 < 0 ? 0 : std::sqrt(sine2);  // NaN stays
  const TableCell g = CellOf(table.gamma_rad, PolarAngle(sine, cosine_gamma));
  if (g.index < 0) return {};
  const double* at = table.cd_per_lm.data() + g.index;
  const double rise = at[1] - at[0];
  return {at[0] + g.share * rise, sine < kSameAngle ? 0 : -rise / (g.width * sine)};
}

IntensityTable Resampled(const IntensityTable& table, int c_step_deg, int gamma_step_deg) {
  if (c_step_deg < 1 || gamma_step_deg < 1 || 360 % c_step_deg != 0 || 180 % gamma_step_deg != 0)
    throw std::invalid_argument("Resampled: expected steps that divide 360 and 180 degrees");
  std::vector<double> c_rad, gamma_rad, intensity;
  for (int c = 0; c < 360; c += c_step_deg) c_rad.push_back(c * M_PI / 180);
  for (int g = 0; g <= 180; g += gamma_step_deg) gamma_rad.push_back(g * M_PI / 180);
  for (const double c : c_rad) {
    for (const double g : gamma_rad)
      intensity.push_back(IntensityTowards(table, DirectionOf(c, g)).cd_per_lm);
  }
  return ExpandPlanes(c_rad, gamma_rad, intensity, PlaneSymmetry::kNone);
}

}  // namespace luxfit
