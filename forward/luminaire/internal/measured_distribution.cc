#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/luminaire/internal/distribution_rows.h"
#include "forward/luminaire/photometry.h"

namespace luxfit {
namespace {

DirectedIntensity MeasuredIntensity(const Luminaire& luminaire, const LuminaireAxes& axes,
                                    const Eigen::Vector3d& direction) {
  if (!luminaire.table) throw std::invalid_argument("IntensityPerLumen: expected a table, got none");
  // C runs from the heading away from `across`: x along, y = -across, z = -aim.
  const TableIntensity at = IntensityTowards(
      *luminaire.table,
      {axes.along.dot(direction), -axes.across.dot(direction), -luminaire.aim.dot(direction)});
  return {
      at.cd_per_lm,
      at.d_direction.x() * axes.along - at.d_direction.y() * axes.across - at.d_direction.z() * luminaire.aim,
      0};
}

// A thousandth of the largest intensity above the horizontal is stray light.
bool IsDarkBehind(const Luminaire& luminaire) {
  const IntensityTable& table = *luminaire.table;
  if (!table.table_from_luminaire.isIdentity()) return false;
  const double largest = *std::max_element(table.cd_per_lm.begin(), table.cd_per_lm.end());
  for (size_t i = 0; i < table.cd_per_lm.size(); ++i) {
    const double gamma = table.gamma_rad[i % table.gamma_rad.size()];
    if (gamma > M_PI / 2 + 1e-6 && table.cd_per_lm[i] > 1e-3 * largest) return false;
  }
  return true;
}

// The peak of cos^m is (m + 1) / (2 pi).
double MeasuredSharpness(const Luminaire& luminaire) {
  return luminaire.table ? std::max(2 * M_PI * luminaire.table->peak_cd_per_lm - 1, 1.0) : 1;
}

}  // namespace

DistributionOps MeasuredDistribution() {
  DistributionOps ops;
  ops.distribution = Distribution::kMeasured;
  ops.name = "measured";
  ops.photometry = "table";
  ops.has_table = true;
  ops.towards = MeasuredIntensity;
  ops.is_symmetric_about_aim = [](const Luminaire& luminaire) {
    return IsSymmetricAboutAim(*luminaire.table);
  };
  ops.shines_to_one_side = IsDarkBehind;
  ops.sharpness = MeasuredSharpness;
  ops.missing = [](const Luminaire& luminaire) {
    return luminaire.table != nullptr ? nullptr : "a table of intensities";
  };
  return ops;
}

}  // namespace luxfit
