#include "inverse/fit/internal/expect_whole.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace luxfit {

void ExpectWhole(const Room& room, const RoomObservations& given) {
  const auto expect = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(std::string("FitRoom: expected ") + what);
  };
  expect(!given.luminaires.empty(), "at least one luminaire");
  expect(!given.dimming.empty(), "at least one state");
  for (const Eigen::VectorXd& dimming : given.dimming)
    expect(dimming.size() == static_cast<Eigen::Index>(given.luminaires.size()),
           "one dimming a luminaire in each state");
  const int states = static_cast<int>(given.dimming.size());
  for (const MeterReading& reading : given.meter.readings)
    expect(reading.state >= 0 && reading.state < states && reading.sensor_index < given.meter.sensor_count,
           "readings of known states and sensors");
  expect(
      given.pose_covariance.rows() % 6 == 0 && given.pose_covariance.rows() == given.pose_covariance.cols(),
      "a pose covariance of six rows and columns a view, or none");
  for (const SeenOutline& outline : given.outlines)
    expect(given.pose_covariance.size() == 0 ||
               Eigen::Index{6} * (outline.view + 1) <= given.pose_covariance.rows(),
           "outlines of views that the pose covariance has");
  expect(given.albedo.empty() || given.albedo.size() == room.scene.materials.size(),
         "one albedo a material, or none");
  const bool has_used = std::any_of(given.meter.readings.begin(), given.meter.readings.end(),
                                    [](const MeterReading& r) { return r.used; });
  expect(!given.observations.empty() || has_used, "observations or readings to fit to");
}

}  // namespace luxfit
