#include "inverse/advise/internal/light_derivatives.h"

namespace luxfit {
namespace {

LightData EachLuminaireAlone(size_t luminaires, const std::vector<int>& elements,
                             const std::vector<Sensor>& sensors) {
  LightData data;
  const auto count = static_cast<Eigen::Index>(luminaires);
  for (Eigen::Index k = 0; k < count; ++k) data.dimming.emplace_back(Eigen::VectorXd::Unit(count, k));
  data.observations.reserve(elements.size() * luminaires);
  data.readings.reserve(sensors.size() * luminaires);
  for (const int element : elements) {
    for (int k = 0; k < count; ++k) {
      Observation& observation = data.observations.emplace_back();
      observation.element = element;
      observation.state = k;
    }
  }
  for (const Sensor& sensor : sensors) {
    for (int k = 0; k < count; ++k) {
      Reading& reading = data.readings.emplace_back();
      reading.sensor = sensor;
      reading.state = k;
    }
  }
  return data;
}

}  // namespace

LightDerivatives::LightDerivatives(const Room& room, const LightState& state,
                                   const std::vector<Parameter>& parameters, const std::vector<int>& elements,
                                   const std::vector<Sensor>& sensors)
    : elements_(elements.size()) {
  const LightData data = EachLuminaireAlone(state.luminaires.size(), elements, sensors);
  LightModel model(room, data);
  model.FreezeVisibility(state);
  light_ = model.Predict(state, parameters, true);
  in_penumbra_ = model.InPenumbra();
}

RelativeRow LightDerivatives::Row(size_t place, const Eigen::VectorXd& dimming) const {
  RelativeRow row;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(light_.jacobian.cols());
  const size_t luminaires = static_cast<size_t>(dimming.size());
  for (size_t k = 0; k < luminaires; ++k) {
    const double on = dimming[static_cast<Eigen::Index>(k)];
    const size_t at = place * luminaires + k;
    if (!(on > 0)) continue;
    if (in_penumbra_[at]) return {};
    row.value += on * light_.value[static_cast<Eigen::Index>(at)];
    sum += on * light_.jacobian.row(static_cast<Eigen::Index>(at)).transpose();
  }
  if (row.value > 0) row.derivative = sum / row.value;
  return row;
}

}  // namespace luxfit
