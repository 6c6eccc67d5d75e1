// Adds keys under their former names. Version 0.1 wrote illuminances in lx as "..._lux"; now they are "..._lx".
// Both stand in result.json for one version, and results of the former version are read.
#ifndef LUXFIT_APPS_TEXT_FORMATS_FORMER_KEYS_H_
#define LUXFIT_APPS_TEXT_FORMATS_FORMER_KEYS_H_

#include <nlohmann/json_fwd.hpp>

namespace luxfit {

// Adds "X_lux" beside every "X_lx", at any depth.
void AddFormerKeys(nlohmann::json& json);
// Adds "X_lx" beside every "X_lux" that has none.
void AddPresentKeys(nlohmann::json& json);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_FORMER_KEYS_H_
