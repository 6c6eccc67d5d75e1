// Separates the light that each group of luminaires gives alone, at places spread through the room.
//
// Groups are those of inverse/model/internal/dimming_groups.h over all observed states. States are sums of the groups' light, so
// least squares at each place gives each group's own light. With photos, the values are the elements'
// relative luminance Y and measured indirect light I (inverse/model/internal/measured_indirect.h); with
// readings alone, the illuminance. Where too few states show a place, only states with one group alone
// count.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUPED_LIGHT_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUPED_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/internal/dimming_groups.h"
#include "inverse/model/light_state.h"

namespace luxfit {

struct GroupedLight {
  std::vector<LuminaireGroup> groups;
  std::vector<std::vector<bool>> is_on;  // by group and state
  bool separable = false;                // the groups' dimming table has full column rank
  std::vector<Sensor> places;
  std::vector<int> material;  // one for each place; -1: a reading
  Eigen::MatrixXd value;      // places x groups: Y or lx; NaN where unknown
  Eigen::MatrixXd indirect;   // I, likewise; 0 for readings
};

// `data`: with measured indirect light, or readings alone. Returns about `max_places` elements, and
// those that narrow beams take beside (inverse/model/internal/search/spread_elements.h).
GroupedLight GroupLight(const Room& room, const LightData& data, int max_places);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_GROUPED_LIGHT_H_
