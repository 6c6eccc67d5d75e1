// Says advice in words and as JSON: what to photograph or read, from where, and what it would tell.
//
// JSON: {"of", "enough", "now": [...], "advice": [{"rank", "kind", "state", "words", "helps", "changes", ...}]}, described by
// docs/schema/advise.schema.json.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_WORDS_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_WORDS_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/commands/internal/advise/advice_given.h"

namespace luxfit {

// Adds the plan to an artifact.
void AddAdvice(const Room& room, const SessionAdvice& advice, const AdvicePlan& plan, double least_gain,
               nlohmann::json& artifact);
// Returns the lines for the terminal.
std::string AdviceText(const nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_ADVISE_ADVICE_WORDS_H_
