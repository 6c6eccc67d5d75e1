#include "inverse/model/internal/blocks/reading_block.h"

namespace luxfit {

RowResponse ReadingBlock::ResponseOf(const LightState& state, int row) const {
  const int sensor = Of(row).sensor_index;
  const double gain = sensor >= 0 && state.sensor_gain.size() > 0 ? state.sensor_gain[sensor] : 1;
  return {state.meter_scale * gain, 0};
}

void ReadingBlock::AddOwnDerivatives(const LightState& state, const std::vector<Parameter>& parameters,
                                     double illuminance_lx, int row,
                                     Eigen::Ref<Eigen::RowVectorXd> derivatives) const {
  for (size_t p = 0; p < parameters.size(); ++p) {
    const Parameter& parameter = parameters[p];
    const bool is_meter = parameter.kind == ParameterKind::kLogMeterScale;
    const bool is_sensor =
        parameter.kind == ParameterKind::kLogSensorGain && parameter.index == Of(row).sensor_index;
    if (is_meter || is_sensor)
      derivatives[static_cast<Eigen::Index>(p)] += ResponseOf(state, row).gain * illuminance_lx;
  }
}

}  // namespace luxfit
