// Returns the form factors of many sensors at once (forward/direct/sensor.h).
//
// Rays are sampled once for each response, in the frame of the sensor, since that costs as much as to trace them. They
// are traced in packets of neighbours.
//
// Throws std::invalid_argument as SensorFormFactors does.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_SENSOR_ROWS_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_SENSOR_ROWS_H_

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "forward/direct/sensor.h"

namespace luxfit {

// Returns a frame whose columns are `facing` (or any tangent), the tangent across it, the normal.
Eigen::Matrix3d SensorFrameOf(const Sensor& sensor);

// Returns the rays of SampleResponse in that frame.
SensorRays SampleInFrame(const SensorResponse& response, int ray_count);

// Returns the weight of every element from rays in the sensor's frame.
Eigen::VectorXf SensorRowOf(const RayScene& rays, const Patches& patches, const Sensor& sensor,
                            const SensorRays& sample);

using SensorRowMatrix = Eigen::SparseMatrix<float, Eigen::RowMajor>;
// Returns SensorFormFactors of all sensors: sensors x elements.
SensorRowMatrix SensorRows(const RayScene& rays, const Patches& patches, const std::vector<Sensor>& sensors,
                           int ray_count);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_SENSOR_ROWS_H_
