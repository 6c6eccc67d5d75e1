// Finds the dimming levels that reach a room's targets at the least power, and what is missing where none do.
//
// Targets are reached with 95 % certainty: every coefficient of light is lowered by its uncertainty
// (inverse/control/dimming.h).
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_LEVEL_PLAN_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_LEVEL_PLAN_H_

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/commands/internal/light_targets.h"

namespace luxfit {

// Returns the power of each luminaire of the room fully on, W. Powers that are not given follow from the flux
// at 100 lm/W.
Eigen::VectorXd PowerOf(const FittedRoom& fitted, const std::map<std::string, double>& given_w);

// Returns {"reached", "power_w", "power_full_w", "luminaires": [...], "targets": [...], "areas": [...],
// "remedies"}.
nlohmann::json LevelPlanJson(const FittedRoom& fitted, const RoomTargets& targets,
                             const std::map<std::string, double>& power_w);
std::string LevelPlanText(const nlohmann::json& plan);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_LEVEL_PLAN_H_
