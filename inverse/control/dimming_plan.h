// Dimming levels of least power that keep light within bounds: a linear programme.
//
//   min p . d   over   lower <= d <= upper,   least_i <= a_i . d <= most_i
//
// d: dimming by luminaire, p: power of each fully on (W), a_i: what one luminaire fully on gives requirement
// i. Light is linear in dimming, so means over areas, uniformity (E_j - U0 mean(E) >= 0) and single points
// all are requirements. What must be reached is reached at the least power, which least squares on the
// targets would not do: it would pay for light that is asked for nowhere.
//
// Where not all requirements can be met, those levels are given that leave the least in all lacking (sum of
// shortages, each over its bound) and `shortage` says where and how much.
//
// Throws std::invalid_argument for sizes that do not fit, powers below 0, bounds that cross.
// Source: Dantzig (1963), "Linear Programming and Extensions"; solved by COIN-OR's Clp (primal and dual
// simplex).
#ifndef LUXFIT_INVERSE_CONTROL_DIMMING_PLAN_H_
#define LUXFIT_INVERSE_CONTROL_DIMMING_PLAN_H_

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

namespace luxfit {

struct LightRequirement {
  std::string name;
  Eigen::VectorXd light;  // by luminaire, fully on
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};

struct DimmingBounds {
  Eigen::VectorXd lower, upper;  // by luminaire
};
DimmingBounds FullRange(Eigen::Index luminaires);  // 0 to 1

struct DimmingPlan {
  bool is_reached = false;  // every requirement is met
  Eigen::VectorXd dimming;
  double power_w = 0;
  std::vector<double> achieved;  // of each requirement
  std::vector<double> shortage;  // below least (or above most), 0 where met
};

DimmingPlan PlanDimming(const Eigen::VectorXd& power_w, const std::vector<LightRequirement>& requirements,
                        const DimmingBounds& bounds);

// Every coefficient lowered by what is not known of the light: met by these, a requirement is met with a
// probability of 95 % and more (errors of the luminaires are added, as if all erred alike).
//
//   a_ik (1 - 1.645 sigma_k)
LightRequirement WithMargin(LightRequirement requirement, const Eigen::VectorXd& relative_sigma);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CONTROL_DIMMING_PLAN_H_
