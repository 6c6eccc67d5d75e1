// Checks sensors: finite numbers and a normal.
//
// Throws std::invalid_argument that names the sensor and what is wrong with it.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_EXPECT_SENSOR_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_EXPECT_SENSOR_H_

#include <vector>

#include "forward/direct/sensor.h"

namespace luxfit {

void ExpectValid(const Sensor& sensor);
void ExpectValid(const std::vector<Sensor>& sensors);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_EXPECT_SENSOR_H_
