// What a stage gave, kept in OUT/stages/NAME.cbor for as long as nothing that it depends on changes.
//
// With the product come the choices and warnings that the stage recorded, so that a run which goes on from it
// says the same. A file that cannot be read counts as none.
//
// Source: RFC 8949 (CBOR).
#ifndef LUXFIT_APPS_STAGES_STAGE_CACHE_H_
#define LUXFIT_APPS_STAGES_STAGE_CACHE_H_

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "apps/stages/stage_inputs.h"
#include "apps/stages/stages.h"

namespace luxfit {

// The product of an earlier run where `inputs` are those it had, else what `compute` gives, which is then
// kept.
nlohmann::json CachedStage(const std::string& stage, const StageInputs& inputs, RunContext& context,
                           const std::function<nlohmann::json()>& compute);

// The inputs that a stage last ran with in this folder; nothing where it has not.
std::optional<StageInputs> LastInputs(const std::string& out, const std::string& stage);

// Inputs for others' use: a whole run, whose product is result.json itself.
void KeepInputs(const std::string& out, const std::string& stage, const StageInputs& inputs);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_STAGE_CACHE_H_
