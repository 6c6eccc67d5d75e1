#include "inverse/model/internal/blocks/reading_block.h"

namespace luxfit {

RowResponse ReadingBlock::ResponseOf(const LightState& state, int row) const {
  const int sensor = Of(row).sensor_index;
  const double gain = sensor >= 0 && state.sensor_gain.size() > 0 ? state.sensor_gain[sensor] : 1;
  return {state.meter_scale * gain, 0};
}

double ReadingBlock::OwnDerivative(const LightState& state, const Parameter& parameter, double illuminance_lx,
                                   int row) const {
  const bool is_meter = parameter.kind == ParameterKind::kLogMeterScale;
  const bool is_sensor =
      parameter.kind == ParameterKind::kLogSensorGain && parameter.index == Of(row).sensor_index;
  return is_meter || is_sensor ? ResponseOf(state, row).gain * illuminance_lx : 0;
}

}  // namespace luxfit
