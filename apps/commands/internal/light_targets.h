// Targets of a room as requirements of a dimming plan: points, means over areas, uniformity.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_LIGHT_TARGETS_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_LIGHT_TARGETS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/commands/internal/design_file.h"
#include "apps/export/fitted_room.h"
#include "apps/session/report_targets.h"
#include "inverse/control/dimming_plan.h"

namespace luxfit {

// Requirements in lx. `needed_lx` is what the requirement says to a person: 0 of uniformity, whose
// requirement is E_j - U0 mean(E) >= 0.
struct RoomRequirement {
  LightRequirement requirement;
  std::string kind;  // point | average | uniformity
  std::string of;    // id of the point or area
};
struct RoomTargets {
  std::vector<RoomRequirement> requirements;
  struct Area {
    std::string id;
    Eigen::MatrixXd light;  // points x luminaires
  };
  std::vector<Area> areas;
};
RoomTargets TargetsOf(const FittedRoom& fitted, const std::vector<DesignPoint>& points,
                      const std::vector<TargetArea>& areas);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_LIGHT_TARGETS_H_
