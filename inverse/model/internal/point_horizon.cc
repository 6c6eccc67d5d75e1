#include "inverse/model/internal/point_horizon.h"

#include <cmath>

namespace luxfit {
namespace {

constexpr double kCutShare = 2 / (3 * M_PI);  // of R / r
constexpr double kRadiusOverDistance = 0.1;   // of a point at most

bool IsCut(const Luminaire& luminaire, double height_m, double distance_m) {
  if (luminaire.shape == LuminaireShape::kSphere) return std::abs(height_m) < luminaire.size_m[0] / 2;
  return luminaire.shape == LuminaireShape::kPoint &&
         std::abs(height_m) < kCutShare * kRadiusOverDistance * distance_m;
}

}  // namespace

bool IsAtHorizonOf(const Luminaire& luminaire, const Sensor& receiver, double least_share) {
  const Eigen::Vector3d to_receiver = receiver.position - luminaire.position;
  const double distance_m = to_receiver.norm();
  if (!IsCut(luminaire, receiver.normal.dot(to_receiver), distance_m)) return false;
  const double cd_per_lm =
      IntensityPerLumen(luminaire, AxesOf(luminaire), to_receiver / distance_m).cd_per_lm;
  return 4 * M_PI * cd_per_lm > least_share;
}

}  // namespace luxfit
