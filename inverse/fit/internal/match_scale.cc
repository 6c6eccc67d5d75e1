#include "inverse/fit/internal/match_scale.h"

#include <utility>

#include "inverse/model/internal/light_model.h"

namespace luxfit {

LightState WithMatchedScale(const Room& room, const RoomObservations& given, const LightData& data,
                            LightState state) {
  LightData readings;
  readings.dimming = data.dimming;
  for (const Reading& reading : data.readings) {
    if (reading.used) readings.readings.push_back(reading);
  }
  LightModel model(room, readings);
  model.FreezeVisibility(state);
  const double modelled = model.Predict(state, {}, false).value.sum();
  double measured = 0;
  for (const Reading& reading : readings.readings) measured += reading.illuminance_lx;
  if (!(measured > 0) || !(modelled > 0)) return state;
  for (size_t k = 0; k < state.luminaires.size(); ++k) {
    if (state.free[k].flux && !given.luminaires[k].flux_lm)
      state.luminaires[k].flux_lm *= measured / modelled;
  }
  state.camera_scale *= modelled / measured;
  return state;
}

}  // namespace luxfit
