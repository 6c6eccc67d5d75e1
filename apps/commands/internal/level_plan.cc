#include "apps/commands/internal/level_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/export/fit_uncertainty.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kAssumedLmPerW = 100;

// Returns the relative sigma of the light of each luminaire.
Eigen::VectorXd LightSigma(const FittedRoom& fitted) {
  const FitUncertainty uncertainty = ReadFitUncertainty(fitted.out);
  const Eigen::VectorXd variance = FluxCovariance(uncertainty, fitted.luminaires).diagonal();
  const double model = uncertainty.relative_model_sigma;
  // Light that the data did not determine could be zero, so the plan does not count on it.
  return variance.unaryExpr([&](double v) { return std::isfinite(v) ? std::sqrt(v + model * model) : 1.0; });
}

// Lowers the light by its uncertainty. The scale that all luminaires share cancels from uniformity, which is
// a ratio.
std::vector<LightRequirement> Assured(const RoomTargets& targets, const Eigen::VectorXd& sigma) {
  std::vector<LightRequirement> requirements;
  requirements.reserve(targets.requirements.size());
  for (const RoomRequirement& r : targets.requirements)
    requirements.push_back(r.kind == "uniformity" ? r.requirement : WithMargin(r.requirement, sigma));
  return requirements;
}

std::string RemedyOf(const FittedRoom& fitted, const LightRequirement& requirement, double lacks_lx) {
  Eigen::Index most = 0;
  requirement.light.maxCoeff(&most);
  const double full_lx = requirement.light.sum();
  if (full_lx >= requirement.least)
    return fmt::format("{}: another requirement holds it down; loosen the uniformity of its area, or move it",
                       requirement.name);
  return fmt::format(
      "{}: lacks {:.0f} lx with everything on; {:.0f} % more flux of all luminaires would do, or {:.0f} lm "
      "more where luminaire {} hangs",
      requirement.name, lacks_lx, 100 * (requirement.least / full_lx - 1),
      lacks_lx / requirement.light[most] * fitted.luminaires[static_cast<size_t>(most)].flux_lm,
      fitted.luminaires[static_cast<size_t>(most)].id);
}

json AreaJson(const RoomTargets::Area& area, const Eigen::VectorXd& dimming) {
  const Eigen::VectorXd lx = area.light * dimming;
  const double mean = lx.mean();
  return {{"id", area.id},
          {"points", lx.size()},
          {"average_lx", mean},
          {"least_lx", lx.minCoeff()},
          {"uniformity", mean > 0 ? json(lx.minCoeff() / mean) : json()}};
}

json TargetJson(const RoomRequirement& target, const LightRequirement& assured, const DimmingPlan& plan,
                double shortage) {
  const LightRequirement& r = target.requirement;
  return {{"name", r.name},
          {"kind", target.kind},
          {"needed_lx", r.least},
          {"reached_lx", r.light.dot(plan.dimming)},
          {"assured95_lx", assured.light.dot(plan.dimming)},
          {"full_on_lx", r.light.sum()},
          {"lacks_lx", shortage}};
}

}  // namespace

Eigen::VectorXd PowerOf(const FittedRoom& fitted, const std::map<std::string, double>& given_w) {
  std::vector<std::string> ids;
  Eigen::VectorXd power_w(static_cast<Eigen::Index>(fitted.luminaires.size()));
  for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
    const Luminaire& luminaire = fitted.luminaires[k];
    ids.push_back(luminaire.id);
    const auto given = given_w.find(luminaire.id);
    power_w[static_cast<Eigen::Index>(k)] =
        given == given_w.end() ? luminaire.flux_lm / kAssumedLmPerW : given->second;
  }
  for (const auto& [id, watts] : given_w) {
    if (std::find(ids.begin(), ids.end(), id) == ids.end())
      throw std::runtime_error("power_w: " + ExpectedOneOf(ids, id));
  }
  return power_w;
}

json LevelPlanJson(const FittedRoom& fitted, const RoomTargets& targets,
                   const std::map<std::string, double>& given_w) {
  const Eigen::VectorXd power_w = PowerOf(fitted, given_w);
  const std::vector<LightRequirement> assured = Assured(targets, LightSigma(fitted));
  const DimmingPlan plan = PlanDimming(power_w, assured, FullRange(power_w.size()));
  json result = {
      {"reached", plan.is_reached},    {"power_w", plan.power_w},
      {"power_full_w", power_w.sum()}, {"power_is_assumed", given_w.size() < fitted.luminaires.size()},
      {"luminaires", json::array()},   {"targets", json::array()},
      {"areas", json::array()},        {"remedies", json::array()}};
  for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
    const Eigen::Index i = static_cast<Eigen::Index>(k);
    result["luminaires"].push_back({{"id", fitted.luminaires[k].id},
                                    {"dimming", plan.dimming[i]},
                                    {"power_w", power_w[i] * plan.dimming[i]},
                                    {"power_full_w", power_w[i]}});
  }
  for (size_t i = 0; i < assured.size(); ++i) {
    // A row for each point of a uniformity would hide the rest; its area shows it.
    const RoomRequirement& target = targets.requirements[i];
    if (target.kind != "uniformity" || plan.shortage[i] > 0)
      result["targets"].push_back(TargetJson(target, assured[i], plan, plan.shortage[i]));
    if (plan.shortage[i] > 0) result["remedies"].push_back(RemedyOf(fitted, assured[i], plan.shortage[i]));
  }
  for (const RoomTargets::Area& area : targets.areas) result["areas"].push_back(AreaJson(area, plan.dimming));
  return result;
}

std::string LevelPlanText(const json& plan) {
  std::string text = "\nluminaire  dimming  power W\n";
  for (const json& l : plan["luminaires"])
    text += fmt::format("{:<10} {:>7.3f}  {:>7.1f}\n", l["id"].get<std::string>(), l["dimming"].get<double>(),
                        l["power_w"].get<double>());
  const double full = plan["power_full_w"].get<double>();
  text +=
      fmt::format("{:.1f} W of {:.1f} W: {:.0f} % saved{}\n", plan["power_w"].get<double>(), full,
                  full > 0 ? 100 * (1 - plan["power_w"].get<double>() / full) : 0,
                  plan["power_is_assumed"].get<bool>() ? " (power by flux, 100 lm/W, where not given)" : "");
  text += "\ntarget                         needed lx  reached lx  sure to 95 %  lacks lx\n";
  for (const json& t : plan["targets"])
    text += fmt::format("{:<30} {:>9.1f}  {:>10.1f}  {:>12.1f}  {:>8.1f}\n", t["name"].get<std::string>(),
                        t["needed_lx"].get<double>(), t["reached_lx"].get<double>(),
                        t["assured95_lx"].get<double>(), t["lacks_lx"].get<double>());
  for (const json& a : plan["areas"])
    text += fmt::format("area {}: E_avg {:.1f} lx, E_min {:.1f} lx, U0 {:.2f}\n", a["id"].get<std::string>(),
                        a["average_lx"].get<double>(), a["least_lx"].get<double>(),
                        a["uniformity"].is_number() ? a["uniformity"].get<double>() : 0.0);
  for (const json& remedy : plan["remedies"]) text += "not reached: " + remedy.get<std::string>() + "\n";
  return text;
}

}  // namespace luxfit
