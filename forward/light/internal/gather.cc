#include "forward/light/internal/gather.h"

#include "forward/factors/form_factors.h"
#include "forward/light/illuminance.h"

namespace luxfit {

Eigen::MatrixXf GatherAtReceivers(const Receivers& receivers, const Eigen::MatrixXf& element_indirect_lx,
                                  const Eigen::MatrixXf& element_exitance) {
  Eigen::MatrixXf at_receivers(receivers.count(), element_indirect_lx.cols());
  const Eigen::Index elements = static_cast<Eigen::Index>(receivers.elements.size());
  for (Eigen::Index c = 0; c < at_receivers.cols(); ++c) {
    for (Eigen::Index r = 0; r < elements; ++r)
      at_receivers(r, c) = element_indirect_lx(receivers.elements[static_cast<size_t>(r)], c);
  }
  at_receivers.bottomRows(receivers.count() - elements) = receivers.sensor_to_element * element_exitance;
  return at_receivers;
}

bool IsPrepared(const Receivers& receivers) {
  return receivers.element_to_patch.rows() > 0 || !receivers.sensor_to_patch.empty();
}

Eigen::MatrixXf GatherEmitted(const Room& room, const Receivers& receivers, const Eigen::VectorXd& albedo,
                              const Eigen::MatrixXf& emitted, const Eigen::MatrixXf& exitance) {
  if (!IsPrepared(receivers)) {
    const Eigen::MatrixXf indirect = IndirectAtElements(room, exitance);
    return GatherAtReceivers(
        receivers, indirect,
        emitted + Eigen::MatrixXf(ElementAlbedo(room.patches, albedo).asDiagonal() * indirect));
  }
  Eigen::MatrixXf at_receivers(receivers.count(), exitance.cols());
  const auto elements = static_cast<Eigen::Index>(receivers.elements.size());
  if (elements > 0) at_receivers.topRows(elements) = Product(receivers.element_to_patch, exitance);
  auto at_sensors = at_receivers.bottomRows(receivers.count() - elements);
  at_sensors = receivers.sensor_to_element * emitted;
  for (size_t m = 0; m < receivers.sensor_to_patch.size(); ++m)
    at_sensors +=
        static_cast<float>(albedo[static_cast<Eigen::Index>(m)]) * (receivers.sensor_to_patch[m] * exitance);
  return at_receivers;
}

}  // namespace luxfit
