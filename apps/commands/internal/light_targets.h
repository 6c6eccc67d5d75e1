// Turns the targets of a room into requirements of a dimming plan: points, means over areas, uniformity.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_LIGHT_TARGETS_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_LIGHT_TARGETS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/commands/internal/design_file.h"
#include "apps/export/fitted_room.h"
#include "apps/session/report_targets.h"
#include "inverse/control/dimming.h"

namespace luxfit {

// Holds one requirement in lx. `needed_lx` is the value shown to a person: 0 for uniformity, whose
// requirement is E_j - U0 mean(E) >= 0.
struct RoomRequirement {
  LightRequirement requirement;
  std::string kind;  // point | average | uniformity
  std::string of;    // id of its point or area
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
