// Adds keys under their former names. Both names stand in what the program writes for one version, and results
// that have only the former names are read.
//
//   present                  former
//   X_lx                     X_lux                        result.json, stages/simulate.json, check --json
//   fix                      mend                         doctor --json
//   relative_sigma_prior     relative_sigma_beforehand    stages/observe.json, which no reader takes it from
#ifndef LUXFIT_APPS_TEXT_FORMATS_FORMER_KEYS_H_
#define LUXFIT_APPS_TEXT_FORMATS_FORMER_KEYS_H_

#include <nlohmann/json_fwd.hpp>

namespace luxfit {

// Adds the former name beside every present one, at any depth.
void AddFormerKeys(nlohmann::json& json);
// Adds "X_lx" beside every "X_lux" that has none.
void AddPresentKeys(nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_FORMER_KEYS_H_
