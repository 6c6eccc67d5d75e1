// Charts the stability of a session's fit: `luxfit chart SESSION -o OUT --stability`.
//
// The session is registered, observed and fitted once. It is then degraded level by level
// (apps/stages/degrade/degradations.h) and fitted again with all steps of `luxfit fit`. Writes OUT/stability.csv,
// OUT/stability_NAME.svg for each degradation, and OUT/stages/stability.json with the edges: the first level
// at which fewer than 90 % of the trials succeed. Each trial appends a line to
// OUT/stages/stability_trials.jsonl, from which a second call continues. The same inputs, options and seed
// give the same tables and pictures.
//
// Throws std::runtime_error for bad input, as the stages do.
#ifndef LUXFIT_APPS_COMMANDS_STUDY_STAGE_STABILITY_H_
#define LUXFIT_APPS_COMMANDS_STUDY_STAGE_STABILITY_H_

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/charts/before_after.h"
#include "apps/stages/stages.h"

namespace luxfit {

struct StabilityOptions {
  int trials = 5;  // trials at each level
  uint64_t seed = 1;
  int elements = 1000;     // observed elements that each fit uses; the whole office takes ten times as long
  std::string truth_path;  // file of true luminaires; empty: the undegraded fit counts as true
  std::vector<std::string> only;  // degradations; empty: all
  EarlierChart before;            // drawn in the same pictures
};

nlohmann::json StabilityOfSession(const Session& session, const StabilityOptions& options,
                                  RunContext& context);
std::string StabilityTable(const nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_STAGE_STABILITY_H_
