#include "inverse/control/commissioning.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "calib/luminance/median.h"
#include "forward/luminaire/distribution_ops.h"
#include "inverse/observe/internal/angle.h"

namespace luxfit {
namespace {

constexpr double kTwoSided95 = 1.96;

// Pairs designed and measured luminaires by distance, nearest pairs first.
std::vector<int> Pairs(const std::vector<Luminaire>& designed, const std::vector<MeasuredLuminaire>& measured,
                       double match_m) {
  std::vector<std::tuple<double, int, int>> near;
  for (size_t i = 0; i < designed.size(); ++i) {
    for (size_t j = 0; j < measured.size(); ++j) {
      const double distance_m = (designed[i].position - measured[j].luminaire.position).norm();
      if (distance_m <= match_m) near.emplace_back(distance_m, static_cast<int>(i), static_cast<int>(j));
    }
  }
  std::sort(near.begin(), near.end());
  std::vector<int> measured_of(designed.size(), -1);
  std::vector<bool> taken(measured.size(), false);
  for (const auto& [distance_m, i, j] : near) {
    int& own = measured_of[static_cast<size_t>(i)];
    if (own >= 0 || taken[static_cast<size_t>(j)]) continue;
    own = j;
    taken[static_cast<size_t>(j)] = true;
  }
  return measured_of;
}

// Returns the sigma along the displacement; where there is none, that of all axes together.
double SigmaAlong(const Eigen::Vector3d& displacement, const Eigen::Vector3d& sigma) {
  const double length = displacement.norm();
  return length > 0 ? displacement.cwiseProduct(sigma).norm() / length : sigma.norm();
}

ToleranceInterval HeadingOf(const Luminaire& designed, const MeasuredLuminaire& measured, double tolerance) {
  if (!DependsOnHeading(designed) || !DependsOnHeading(measured.luminaire)) return {0, 0, tolerance, false};
  double angle = AngleBetween(AxesOf(designed).along, AxesOf(measured.luminaire).along);
  // Half a turn does not change an even rectangle.
  if (OpsOf(designed.distribution).about_aim != nullptr) angle = std::min(angle, M_PI - angle);
  return {angle, kTwoSided95 * measured.heading_sigma_rad, tolerance, true};
}

void Judge(const Luminaire& designed, const MeasuredLuminaire& measured, const CommissioningOptions& options,
           CommissionedLuminaire& verdict) {
  const Eigen::Vector3d displacement = measured.luminaire.position - designed.position;
  const double ratio = measured.luminaire.flux_lm / designed.flux_lm;
  verdict.moved_m = {displacement.norm(), kTwoSided95 * SigmaAlong(displacement, measured.position_sigma_m),
                     options.position_m, true};
  verdict.aim_rad = {AngleBetween(designed.aim, measured.luminaire.aim), kTwoSided95 * measured.aim_sigma_rad,
                     options.angle_rad, true};
  verdict.heading_rad = HeadingOf(designed, measured, options.angle_rad);
  verdict.flux_ratio_less_1 = {ratio - 1, kTwoSided95 * ratio * measured.relative_flux_sigma,
                               options.relative_flux, std::isfinite(measured.relative_flux_sigma)};
  verdict.distribution = {DistributionDistance(designed, measured.luminaire),
                          kTwoSided95 * measured.distribution_sigma, options.distribution_share, true};
  const auto fault = [&](bool is, CommissioningFault kind) {
    if (is) verdict.faults.push_back(kind);
  };
  if (ratio < options.off_share) {
    verdict.faults = {CommissioningFault::kOff};
    return;
  }
  fault(verdict.moved_m.IsBeyond(), CommissioningFault::kMoved);
  fault(verdict.aim_rad.IsBeyond(), CommissioningFault::kAimTurned);
  fault(verdict.heading_rad.IsBeyond(), CommissioningFault::kHeadingTurned);
  fault(verdict.flux_ratio_less_1.IsBeyond() && ratio < 1, CommissioningFault::kWeak);
  fault(verdict.flux_ratio_less_1.IsBeyond() && ratio > 1, CommissioningFault::kStrong);
  fault(verdict.distribution.IsBeyond(), CommissioningFault::kPhotometry);
}

// Finds two pairs whose ids are exchanged.
void FindSwapped(const std::vector<Luminaire>& designed, const std::vector<MeasuredLuminaire>& measured,
                 std::vector<CommissionedLuminaire>& luminaires) {
  for (CommissionedLuminaire& a : luminaires) {
    for (const CommissionedLuminaire& b : luminaires) {
      if (a.measured < 0 || b.measured < 0 || a.designed == b.designed) continue;
      const auto id = [&](const CommissionedLuminaire& of) -> const std::string& {
        return measured[static_cast<size_t>(of.measured)].luminaire.id;
      };
      if (id(a) != designed[static_cast<size_t>(b.designed)].id ||
          id(b) != designed[static_cast<size_t>(a.designed)].id)
        continue;
      a.swapped_with = b.designed;
      a.faults.push_back(CommissioningFault::kSwapped);
    }
  }
}

double MedianRatio(const std::vector<CommissionedLuminaire>& luminaires) {
  std::vector<double> ratios;
  for (const CommissionedLuminaire& l : luminaires) {
    if (l.measured >= 0) ratios.push_back(1 + l.flux_ratio_less_1.value);
  }
  return ratios.empty() ? 1 : Quantile(std::move(ratios), 0.5);
}

}  // namespace

std::string ToString(CommissioningFault fault) {
  switch (fault) {
    case CommissioningFault::kOff:
      return "off";
    case CommissioningFault::kMoved:
      return "moved";
    case CommissioningFault::kAimTurned:
      return "aim turned";
    case CommissioningFault::kHeadingTurned:
      return "heading turned";
    case CommissioningFault::kWeak:
      return "dimmed or weak";
    case CommissioningFault::kStrong:
      return "too strong";
    case CommissioningFault::kPhotometry:
      return "wrong photometry";
    case CommissioningFault::kSwapped:
      return "swapped";
  }
  return "";
}

double DistributionDistance(const Luminaire& a, const Luminaire& b) {
  constexpr int kGammas = 180, kPlanes = 24;
  const LuminaireAxes axes_a = AxesOf(a), axes_b = AxesOf(b);
  const auto towards = [](const Luminaire& l, const LuminaireAxes& axes, double gamma, double c) {
    const Eigen::Vector3d direction = std::cos(gamma) * l.aim + std::sin(gamma) * std::cos(c) * axes.along -
                                      std::sin(gamma) * std::sin(c) * axes.across;
    return IntensityPerLumen(l, axes, direction).cd_per_lm;
  };
  double sum = 0;
  for (int i = 0; i < kGammas; ++i) {
    const double gamma = (i + 0.5) * M_PI / kGammas;
    const double ring = std::cos(i * M_PI / kGammas) - std::cos((i + 1) * M_PI / kGammas);
    for (int j = 0; j < kPlanes; ++j) {
      const double c = (j + 0.5) * 2 * M_PI / kPlanes;
      sum +=
          ring * 2 * M_PI / kPlanes * std::abs(towards(a, axes_a, gamma, c) - towards(b, axes_b, gamma, c));
    }
  }
  return 0.5 * sum;
}

Commissioning CompareWithDesign(const std::vector<Luminaire>& designed,
                                const std::vector<MeasuredLuminaire>& measured,
                                const CommissioningOptions& options) {
  for (const Luminaire& luminaire : designed) {
    if (!(luminaire.flux_lm > 0))
      throw std::invalid_argument("CompareWithDesign: expected a flux above 0 of " + luminaire.id);
  }
  Commissioning commissioning;
  const std::vector<int> measured_of = Pairs(designed, measured, options.match_m);
  for (size_t i = 0; i < designed.size(); ++i) {
    CommissionedLuminaire verdict;
    verdict.designed = static_cast<int>(i);
    verdict.measured = measured_of[i];
    if (verdict.measured < 0) {
      verdict.faults = {CommissioningFault::kOff};
    } else {
      Judge(designed[i], measured[static_cast<size_t>(verdict.measured)], options, verdict);
    }
    commissioning.luminaires.push_back(verdict);
  }
  FindSwapped(designed, measured, commissioning.luminaires);
  for (size_t j = 0; j < measured.size(); ++j) {
    if (std::find(measured_of.begin(), measured_of.end(), static_cast<int>(j)) == measured_of.end())
      commissioning.undesigned.push_back(static_cast<int>(j));
  }
  commissioning.common_flux_ratio = MedianRatio(commissioning.luminaires);
  return commissioning;
}

}  // namespace luxfit
