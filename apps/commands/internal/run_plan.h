// Plans what a run would do and why, stage by stage, from what has changed since the last one into its
// folder.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_RUN_PLAN_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_RUN_PLAN_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/stages/stage_inputs.h"

namespace luxfit {

struct PlannedStage {
  std::string stage;
  bool runs = true;
  std::string because;
};

struct RunPlan {
  std::vector<PlannedStage> stages;
  bool is_up_to_date = false;  // nothing runs
};

// `result` are the inputs of result.json with the hashes of the files that the run leaves.
RunPlan PlanOf(const SessionInputs& inputs, const StageInputs& result, const std::string& out);

std::string PlanText(const RunPlan& plan);
nlohmann::json PlanJson(const RunPlan& plan);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_RUN_PLAN_H_
