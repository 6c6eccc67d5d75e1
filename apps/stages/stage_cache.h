// Keeps the product of a stage in OUT/stages/NAME.cbor as long as nothing that it depends on changes.
//
// The choices and warnings that the stage recorded are kept with the product, so that a run that reuses it
// reports the same. A file that is damaged (its hash is not that of its content) is ignored: the stage runs again.
//
// Source: RFC 8949 (CBOR).
#ifndef LUXFIT_APPS_STAGES_STAGE_CACHE_H_
#define LUXFIT_APPS_STAGES_STAGE_CACHE_H_

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "apps/stages/stage_inputs.h"
#include "apps/stages/stages.h"

namespace luxfit {

// Returns the product that an earlier run kept where `inputs` are the same as then, and reports what that run
// reported. Returns nothing where the stage has to run.
std::optional<nlohmann::json> KeptProduct(const std::string& stage, const StageInputs& inputs,
                                          RunContext& context);

// Marks where the reports of a stage begin.
struct StageMark {
  explicit StageMark(const RunContext& context)
      : choices(context.choices.size()), warnings(context.warnings.size()) {}
  size_t choices, warnings;
};
// Keeps a product for the next run, with what the stage reported since `mark`.
void KeepProduct(const std::string& stage, const StageInputs& inputs, const RunContext& context,
                 const StageMark& mark, const nlohmann::json& product);

// Returns the inputs that a stage last ran with in this folder; nothing where it has not run.
std::optional<StageInputs> LastInputs(const std::string& out, const std::string& stage);

// Keeps the inputs of a whole run, whose product is result.json itself.
void KeepInputs(const std::string& out, const std::string& stage, const StageInputs& inputs);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGE_CACHE_H_
