// Luxmeter readings against their predictions: what `luxfit check` prints and `check` in result.json holds.
//
// Rows of the table: one a meter id over its states, the mean of all, the mean of a subset. Errors are in lx
// and in percent of the mean reading of the row, as published comparisons give them. Only readings with role
// "check" that were measured and predicted take part.
#ifndef LUXFIT_APPS_STAGES_CHECK_REPORT_H_
#define LUXFIT_APPS_STAGES_CHECK_REPORT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace luxfit {

// `luxmeter`: that of result.json. `subset`: a pattern, id or id@state; empty: none. Throws
// std::runtime_error where it matches no reading that checks.
nlohmann::json CheckJson(const nlohmann::json& luxmeter, const std::string& subset = "");

// The same for the terminal.
std::string CheckText(const nlohmann::json& check);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CHECK_REPORT_H_
