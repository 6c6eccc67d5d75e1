#include "forward/direct/internal/sensor_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "forward/direct/internal/expect_sensor.h"

namespace luxfit {
namespace {

// Holds the rays of every response that occurs among sensors, in the sensors' frames: most have the same.
class ResponseSamples {
 public:
  ResponseSamples(const std::vector<Sensor>& sensors, int ray_count) {
    std::vector<const SensorResponse*> known;
    for (const Sensor& sensor : sensors) {
      const auto at = std::find_if(known.begin(), known.end(), [&](const SensorResponse* r) {
        return IsSampledAlike(*r, sensor.response);
      });
      of_sensor_.push_back(static_cast<size_t>(at - known.begin()));
      if (at != known.end()) continue;
      known.push_back(&sensor.response);
      samples_.push_back(SampleInFrame(sensor.response, ray_count));
    }
  }
  const SensorRays& OfSensor(size_t sensor) const { return samples_[of_sensor_[sensor]]; }

 private:
  static bool IsSampledAlike(const SensorResponse& a, const SensorResponse& b) {
    return a.kind == b.kind && a.angle_rad == b.angle_rad && a.relative == b.relative;
  }

  std::vector<SensorRays> samples_;
  std::vector<size_t> of_sensor_;
};

// Returns the rows as one matrix; they are appended, since a row that is assigned moves all those behind it.
SensorRowMatrix SensorRowsAsMatrix(const std::vector<Eigen::SparseVector<float>>& rows,
                                   Eigen::Index columns) {
  SensorRowMatrix matrix(static_cast<Eigen::Index>(rows.size()), columns);
  Eigen::Index entries = 0;
  for (const Eigen::SparseVector<float>& row : rows) entries += row.nonZeros();
  matrix.reserve(entries);
  for (size_t i = 0; i < rows.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    matrix.startVec(index);
    for (Eigen::SparseVector<float>::InnerIterator it(rows[i]); it; ++it)
      matrix.insertBack(index, it.index()) = it.value();
  }
  matrix.finalize();
  return matrix;
}

}  // namespace

Eigen::VectorXf SensorRowOf(const RayScene& rays, const Patches& patches, const Sensor& sensor,
                            const SensorRays& sample) {
  const Eigen::Matrix3f frame = SensorFrameOf(sensor).cast<float>();
  const Eigen::Vector3f start = RayOrigin(sensor).cast<float>();
  const Eigen::Index count = sample.directions.cols();
  Eigen::VectorXf row = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(patches.elements.size()));
  for (Eigen::Index first = 0; first < count; first += RayPacket::kSize) {
    RayPacket packet;
    for (Eigen::Index k = first; k < std::min<Eigen::Index>(first + RayPacket::kSize, count); ++k)
      packet.Add(start, frame * sample.directions.col(k).cast<float>());
    const PacketHits hits = rays.Trace(packet);
    for (int k = 0; k < packet.count; ++k) {
      if (hits.facet[k] < 0 || !hits.front[k]) continue;
      if (const int element = patches.ElementAt(hits.facet[k], hits.u[k], hits.v[k]); element >= 0)
        row[element] += 1.0f;
    }
  }
  return static_cast<float>(sample.total / static_cast<double>(count)) * row;
}

SensorRowMatrix SensorRows(const RayScene& rays, const Patches& patches, const std::vector<Sensor>& sensors,
                           int ray_count) {
  ExpectValid(sensors);
  std::vector<Eigen::SparseVector<float>> rows(sensors.size());
  // Without elements there is nothing to gather from.
  if (!patches.elements.empty()) {
    const ResponseSamples samples(sensors, ray_count);
    tbb::parallel_for(size_t{0}, sensors.size(), [&](size_t i) {
      rows[i] = SensorRowOf(rays, patches, sensors[i], samples.OfSensor(i)).sparseView();
    });
  }
  return SensorRowsAsMatrix(rows, static_cast<Eigen::Index>(patches.elements.size()));
}

}  // namespace luxfit
