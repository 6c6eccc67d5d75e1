#include "inverse/control/dimming.h"

#include <ClpSimplex.hpp>
#include <CoinPackedVector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

// Shortages cost more than any power could save.
constexpr double kShortageCost = 1e4;
constexpr double kTolerance = 1e-6;

void ExpectSizes(const Eigen::VectorXd& power_w, const std::vector<LightRequirement>& requirements,
                 const DimmingBounds& bounds) {
  const Eigen::Index count = power_w.size();
  if (bounds.lower.size() != count || bounds.upper.size() != count ||
      (bounds.lower.array() > bounds.upper.array()).any() || !power_w.allFinite() ||
      (power_w.array() < 0).any())
    throw std::invalid_argument("PlanDimming: expected powers >= 0 and a range for each luminaire");
  for (const LightRequirement& r : requirements) {
    if (r.light.size() != count || !r.light.allFinite() || r.least > r.most)
      throw std::invalid_argument("PlanDimming: expected light of each luminaire for " + r.name);
  }
}

// Returns the unit in which a requirement's shortage is measured.
double ScaleOf(const LightRequirement& r) {
  const double bound = std::isfinite(r.most) ? std::max(std::abs(r.least), std::abs(r.most)) : r.least;
  return std::max(std::abs(bound), std::max(r.light.cwiseAbs().maxCoeff(), 1e-9) * 1e-3);
}

// Loads columns for dimming, then one shortage and one excess for each requirement. ScaleOf scales the rows.
void Load(ClpSimplex& model, const Eigen::VectorXd& power_w,
          const std::vector<LightRequirement>& requirements, const DimmingBounds& bounds) {
  const int luminaires = static_cast<int>(power_w.size()), rows = static_cast<int>(requirements.size());
  const double power_scale = std::max(power_w.sum(), 1e-9);
  model.setLogLevel(0);
  model.resize(0, luminaires + 2 * rows);
  for (int k = 0; k < luminaires; ++k) {
    model.setColumnBounds(k, bounds.lower[k], bounds.upper[k]);
    model.setObjectiveCoefficient(k, power_w[k] / power_scale);
  }
  for (int k = luminaires; k < luminaires + 2 * rows; ++k) {
    model.setColumnBounds(k, 0, COIN_DBL_MAX);
    model.setObjectiveCoefficient(k, kShortageCost);
  }
  for (int i = 0; i < rows; ++i) {
    const LightRequirement& r = requirements[static_cast<size_t>(i)];
    const double scale = ScaleOf(r);
    CoinPackedVector row;
    for (int k = 0; k < luminaires; ++k) row.insert(k, r.light[k] / scale);
    row.insert(luminaires + 2 * i, 1.0);
    row.insert(luminaires + 2 * i + 1, -1.0);
    model.addRow(row.getNumElements(), row.getIndices(), row.getElements(),
                 std::isfinite(r.least) ? r.least / scale : -COIN_DBL_MAX,
                 std::isfinite(r.most) ? r.most / scale : COIN_DBL_MAX);
  }
}

}  // namespace

DimmingBounds FullRange(Eigen::Index luminaires) {
  return {Eigen::VectorXd::Zero(luminaires), Eigen::VectorXd::Ones(luminaires)};
}

DimmingPlan PlanDimming(const Eigen::VectorXd& power_w, const std::vector<LightRequirement>& requirements,
                        const DimmingBounds& bounds) {
  ExpectSizes(power_w, requirements, bounds);
  ClpSimplex model;
  Load(model, power_w, requirements, bounds);
  model.initialSolve();
  if (!model.isProvenOptimal())
    throw std::logic_error("PlanDimming: the programme always has a solution, but none was found");
  DimmingPlan plan;
  plan.dimming = Eigen::Map<const Eigen::VectorXd>(model.getColSolution(), power_w.size())
                     .cwiseMax(bounds.lower)
                     .cwiseMin(bounds.upper);
  plan.power_w = power_w.dot(plan.dimming);
  plan.is_reached = true;
  for (const LightRequirement& r : requirements) {
    const double value = r.light.dot(plan.dimming);
    const double shortage = std::max({0.0, r.least - value, value - r.most});
    plan.shortage.push_back(shortage > kTolerance * ScaleOf(r) ? shortage : 0);
    plan.is_reached = plan.is_reached && plan.shortage.back() == 0;
  }
  return plan;
}

LightRequirement WithMargin(LightRequirement requirement, const Eigen::VectorXd& relative_sigma) {
  constexpr double kOneSided95 = 1.645;
  if (relative_sigma.size() != requirement.light.size())
    throw std::invalid_argument("WithMargin: expected a sigma for each luminaire");
  requirement.light = requirement.light.array() * (1 - kOneSided95 * relative_sigma.array()).max(0);
  return requirement;
}

}  // namespace luxfit
