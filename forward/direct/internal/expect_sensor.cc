#include "forward/direct/internal/expect_sensor.h"

#include <string>

#include "forward/room/internal/expect_valid.h"

namespace luxfit {
namespace {

void ExpectSensor(const Sensor& sensor, const std::string& name) {
  ExpectThat(sensor.position.allFinite(), name, "a finite position");
  ExpectThat(sensor.normal.allFinite() && sensor.normal.norm() > 0, name, "a finite normal other than 0");
  ExpectThat(sensor.response.facing.allFinite(), name, "a finite direction that it faces");
}

}  // namespace

void ExpectValid(const Sensor& sensor) { ExpectSensor(sensor, "sensor"); }

void ExpectValid(const std::vector<Sensor>& sensors) {
  for (size_t i = 0; i < sensors.size(); ++i) ExpectSensor(sensors[i], "sensor " + std::to_string(i));
}

}  // namespace luxfit
