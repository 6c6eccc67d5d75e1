// Writes identities of fitted parameters as JSON, and reads them back.
//
//   {"kind": "luminaire", "luminaire": "A", "quantity": "gamma_node", "part": 3}   or   {"kind": "albedo", "material": "floor"}
//
// Throws nlohmann::json::exception where a key is missing or a word unknown.
#ifndef LUXFIT_APPS_STAGES_PARAMETER_JSON_H_
#define LUXFIT_APPS_STAGES_PARAMETER_JSON_H_

#include <nlohmann/json_fwd.hpp>

#include "inverse/model/parameter.h"

namespace luxfit {

nlohmann::json IdJson(const ParameterId& id);
ParameterId IdFromJson(const nlohmann::json& entry);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_PARAMETER_JSON_H_
