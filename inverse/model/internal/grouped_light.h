// What each group of luminaires gives alone, at places spread through the room.
//
// Luminaires whose dimming is in one proportion in all observed states are one group: no sum of states tells
// them apart. Those that were never on belong to none. States are sums of the groups' light, so a group's own
// is got back by least squares, place by place: of photos the elements' relative luminance Y and measured
// indirect light I (inverse/model/measured_indirect.h), of readings alone the illuminance. Where a place was not
// seen in enough states, what was seen of the group alone counts.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_GROUPED_LIGHT_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_GROUPED_LIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_model.h"

namespace luxfit {

struct LuminaireGroup {
  std::vector<int> luminaires;
  std::vector<double> share;  // of each: its dimming over the group's
};

struct GroupedLight {
  std::vector<LuminaireGroup> groups;
  bool separable = false;  // the groups' dimming table has full column rank
  std::vector<Sensor> places;
  std::vector<int> material;  // of each place; -1: a reading
  Eigen::MatrixXd value;      // places x groups: Y or lx; NaN where not known
  Eigen::MatrixXd indirect;   // likewise I; 0 for readings
};

// `data` with measured indirect light, or readings alone. At most about `max_places` elements.
GroupedLight GroupLight(const Room& room, const LightData& data, int max_places);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_GROUPED_LIGHT_H_
