#include "inverse/control/dimming.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

// Returns the sigma of 1 - (a.d)/(a.d0), where each a_k errs with its flux.
double DropSigma(const Eigen::VectorXd& light, const Eigen::VectorXd& now, const Eigen::VectorXd& then,
                 const Eigen::MatrixXd& log_flux_covariance) {
  const double before = light.dot(now), after = light.dot(then);
  if (!(before > 0)) return 0;
  const Eigen::VectorXd gradient =
      light.cwiseProduct(then) / before - after / (before * before) * light.cwiseProduct(now);
  return std::sqrt(std::max(0.0, gradient.dot(log_flux_covariance * gradient)));
}

}  // namespace

bool IsInView(const RayScene& rays, const Luminaire& luminaire, const Gaze& gaze, double half_angle_rad) {
  const Eigen::Vector3d to = luminaire.position - gaze.eye_m;
  const double distance_m = to.norm();
  if (!(distance_m > 0) || gaze.direction.dot(to) < std::cos(half_angle_rad) * distance_m) return false;
  const Eigen::Vector3d leaves = -to / distance_m;
  if (!(IntensityPerLumen(luminaire, AxesOf(luminaire), leaves).cd_per_lm > 0)) return false;
  constexpr double kOffMountM = 0.005;  // a luminaire may lie in the plane of its ceiling
  return !rays.Occluded(gaze.eye_m, luminaire.position + kOffMountM * leaves);
}

UnseenDimming DimUnseen(const EyeLight& eyes, const Eigen::VectorXd& now, const Eigen::VectorXd& power_w,
                        double drop, const Eigen::MatrixXd& log_flux_covariance) {
  const Eigen::Index persons = eyes.light_lx.rows(), luminaires = now.size();
  if (!(drop >= 0) || !(drop <= 1) || eyes.light_lx.cols() != luminaires || eyes.in_view.rows() != persons ||
      eyes.in_view.cols() != luminaires || power_w.size() != luminaires ||
      log_flux_covariance.rows() != luminaires)
    throw std::invalid_argument("DimUnseen: expected light and power of each luminaire, a drop in 0..1");
  UnseenDimming unseen;
  DimmingBounds bounds{Eigen::VectorXd::Zero(luminaires), now};
  for (Eigen::Index k = 0; k < luminaires; ++k) {
    if (eyes.in_view.col(k).any()) bounds.lower[k] = (1 - drop) * now[k];
  }
  unseen.alone = bounds.lower;
  std::vector<LightRequirement> requirements;
  for (Eigen::Index p = 0; p < persons; ++p) {
    const Eigen::VectorXd light = eyes.light_lx.row(p);
    const double before = light.dot(now);
    requirements.push_back({"person " + std::to_string(p + 1), light, (1 - drop) * before});
    for (Eigen::Index k = 0; k < luminaires; ++k) {
      if (light[k] > 0) unseen.alone[k] = std::max(unseen.alone[k], now[k] - drop * before / light[k]);
    }
  }
  const DimmingPlan plan = PlanDimming(power_w, requirements, bounds);
  unseen.dimming = plan.dimming;
  unseen.power_w = plan.power_w;
  unseen.power_before_w = power_w.dot(now);
  for (Eigen::Index p = 0; p < persons; ++p) {
    const Eigen::VectorXd light = eyes.light_lx.row(p);
    const double before = light.dot(now);
    unseen.drop.push_back(before > 0 ? 1 - light.dot(plan.dimming) / before : 0);
    unseen.drop_sigma.push_back(DropSigma(light, now, plan.dimming, log_flux_covariance));
  }
  return unseen;
}

}  // namespace luxfit
