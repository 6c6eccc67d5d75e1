// Compares luxmeter readings with their predictions, for `luxfit check` and for `check` in result.json.
//
// The table has one row for each meter id over its states, the mean of all, and the mean of a subset. Errors
// are in lx and in percent of the mean reading of the row, as published comparisons give them. Only readings
// with role "check" that were measured and predicted are used. Errors are null where there are none.
#ifndef LUXFIT_APPS_STAGES_CHECK_CHECK_REPORT_H_
#define LUXFIT_APPS_STAGES_CHECK_CHECK_REPORT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "inverse/check/luxmeter_check.h"

namespace luxfit {

// Returns those of `luxmeter` of result.json that check.
std::vector<NamedReading> CheckedReadings(const nlohmann::json& luxmeter);

// Returns `summary` of result.json and of stages/simulate.json.
nlohmann::json SummaryJson(const LuxmeterSummary& summary);

// `luxmeter` is that of result.json. `subset` is a pattern, id or id@state; empty means none. Throws
// std::runtime_error where it matches no reading that checks.
nlohmann::json CheckJson(const nlohmann::json& luxmeter, const std::string& subset = "");

// Formats the comparison for the terminal.
std::string CheckText(const nlohmann::json& check);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_CHECK_CHECK_REPORT_H_
