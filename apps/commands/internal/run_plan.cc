#include "apps/commands/internal/run_plan.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "apps/stages/stage_cache.h"

namespace luxfit {
namespace {

constexpr size_t kNamedChanges = 4;

PlannedStage Plan(const std::string& stage, const StageInputs& inputs, const std::string& out) {
  const std::optional<StageInputs> last = LastInputs(out, stage);
  if (!last) return {stage, true, "no earlier run left it, whole, in " + out};
  const std::vector<std::string> changed = ChangedInputs(*last, inputs);
  if (changed.empty()) return {stage, false, "nothing that it depends on has changed"};
  std::string names;
  for (size_t i = 0; i < changed.size() && i < kNamedChanges; ++i) names += (i > 0 ? ", " : "") + changed[i];
  if (changed.size() > kNamedChanges) names += fmt::format(" and {} more", changed.size() - kNamedChanges);
  return {stage, true, "changed since the last run: " + names};
}

}  // namespace

RunPlan PlanOf(const SessionInputs& inputs, const StageInputs& result, const std::string& out) {
  PlannedStage fit = Plan("result", result, out);
  fit.stage = "fit";
  RunPlan plan;
  plan.is_up_to_date = !fit.runs;
  plan.stages = {{"scene", fit.runs, fit.runs ? "form factors are computed anew for every fit" : fit.because},
                 Plan("linearize", inputs.linearize, out),
                 Plan("register", inputs.registration, out),
                 Plan("observe", inputs.observe, out),
                 fit};
  return plan;
}

std::string PlanText(const RunPlan& plan) {
  std::string text;
  for (const PlannedStage& stage : plan.stages)
    text += fmt::format("{:<9} {:<7} {}\n", stage.stage, stage.runs ? "runs" : "stands", stage.because);
  return text;
}

nlohmann::json PlanJson(const RunPlan& plan) {
  nlohmann::json stages = nlohmann::json::array();
  for (const PlannedStage& stage : plan.stages)
    stages.push_back({{"stage", stage.stage}, {"runs", stage.runs}, {"because", stage.because}});
  return {{"stages", stages}, {"up_to_date", plan.is_up_to_date}};
}

}  // namespace luxfit
