#include "inverse/fit/internal/judge/predict_readings.h"

#include <algorithm>
#include <vector>

#include "inverse/model/fitted_light.h"
#include "inverse/model/internal/blocks/reading_block.h"
#include "inverse/model/internal/blocks/row_block.h"

namespace luxfit {

LuminaireFit WithPredictedReadings(const Room& room, const LightData& data, LuminaireFit fit) {
  if (fit.predicted.size() == 0 || data.readings.empty()) return fit;
  std::vector<Sensor> places;  // a point read in several states is one place
  std::vector<Eigen::Index> place_of_reading;
  for (const Reading& reading : data.readings) {
    const auto known = std::find(places.begin(), places.end(), reading.sensor);
    place_of_reading.push_back(known - places.begin());
    if (known == places.end()) places.push_back(reading.sensor);
  }
  const PlaceLight light = FittedLight(room, FittedSceneOf(fit, data)).LightAt(places);
  std::vector<Eigen::VectorXd> state_lx;
  for (const Eigen::VectorXd& dimming : data.dimming) state_lx.push_back(light.Under(dimming));
  const ReadingBlock block(data);
  const Eigen::Index first = FirstReadingRow(data);
  fit.reading_direct_lx.resize(static_cast<Eigen::Index>(data.readings.size()), light.direct_lx.cols());
  for (size_t i = 0; i < data.readings.size(); ++i) {
    const auto state = static_cast<size_t>(data.readings[i].state);
    const auto reading = static_cast<Eigen::Index>(i);
    const Eigen::Index place = place_of_reading[i];
    const double gain = block.ResponseOf(fit.state, static_cast<int>(i)).gain;
    fit.predicted[first + reading] = gain * state_lx[state][place];
    fit.reading_direct_lx.row(reading) =
        gain * light.direct_lx.row(place).cwiseProduct(data.dimming[state].transpose());
  }
  return fit;
}

}  // namespace luxfit
