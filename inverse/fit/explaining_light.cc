#include "inverse/fit/explaining_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "forward/room/in_room.h"
#include "inverse/model/internal/light_model.h"

namespace luxfit {
namespace {

constexpr double kNoPlace = std::numeric_limits<double>::quiet_NaN();

bool IsPlaceInRoom(const Room& room, const Sensor& place) {
  return place.position.allFinite() &&
         (room.scene.facets.empty() || IsInRoom(room.rays, LiftedOff(place.position, place.normal)));
}

Eigen::MatrixXd LightInStates(const Room& room, const RoomFit& fit, const std::vector<Sensor>& places) {
  std::vector<Sensor> asked;  // each place once
  std::vector<size_t> index;
  for (const Sensor& place : places) {
    const auto known = std::find(asked.begin(), asked.end(), place);
    index.push_back(static_cast<size_t>(known - asked.begin()));
    if (known == asked.end()) asked.push_back(place);
  }
  const auto states = static_cast<Eigen::Index>(fit.data.dimming.size());
  LightData data;
  data.dimming = fit.data.dimming;
  std::vector<Eigen::Index> first_row(asked.size(), -1);
  for (size_t p = 0; p < asked.size(); ++p) {
    if (!IsPlaceInRoom(room, asked[p])) continue;
    first_row[p] = static_cast<Eigen::Index>(data.readings.size());
    for (int s = 0; s < states; ++s) data.readings.push_back({asked[p], s});
  }
  Eigen::MatrixXd lit = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(places.size()), states, kNoPlace);
  if (data.readings.empty()) return lit;
  LightModel model(room, data);
  model.FreezeVisibility(fit.fit.state);
  const Eigen::VectorXd predicted = model.Predict(fit.fit.state, {}, false).value;
  for (size_t i = 0; i < places.size(); ++i) {
    const Eigen::Index row = first_row[index[i]];
    if (row >= 0) lit.row(static_cast<Eigen::Index>(i)) = predicted.segment(row, states);
  }
  return lit;
}

// Returns the height of the highest surface below the ceiling that faces up at (x, y); NaN where there is none.
double TopAt(const Room& room, double x, double y) {
  Eigen::Vector3d from(x, y, room.scene.Bounds().max().z() + 1);
  constexpr int kMostSurfaces = 64;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const RayHit hit = room.rays.Trace(from, -Eigen::Vector3d::UnitZ());
    if (hit.facet < 0) break;
    from.z() -= hit.distance;
    if (hit.front) return from.z();
    from.z() -= 1e-5;  // through the ceiling, from its back
  }
  return kNoPlace;
}

// Returns the median of what the predictions of the fit's readings are uncertain by, relative. Misread readings that
// the fit uses raise it, which must not hide them.
double PredictionSigma(const RoomFit& fit) {
  constexpr double kMost = 0.05;
  std::vector<double> sigmas;
  for (const PredictedReading& r : PredictedReadings(fit))
    if (r.is_known && r.illuminance_lx > 0) sigmas.push_back(r.sigma_lx / r.illuminance_lx);
  if (sigmas.empty()) return std::min(kMost, fit.fit.shared_relative_sigma);
  std::nth_element(sigmas.begin(), sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2),
                   sigmas.end());
  return std::min(kMost, sigmas[sigmas.size() / 2]);
}

bool RestsOnReadings(const RoomFit& fit) {
  const std::vector<FreeQuantities>& free = fit.fit.state.free;
  return fit.data.observations.empty() &&
         std::any_of(free.begin(), free.end(), [](const FreeQuantities& f) { return f.position || f.flux; });
}

}  // namespace

std::optional<ExplainingLight> ExplainingLightOf(const Room& room, const RoomFit& fit,
                                                 const std::vector<std::string>& states) {
  if (!fit.IsUsable() || RestsOnReadings(fit)) return std::nullopt;
  ExplainingLight light;
  light.in_states = [&room, &fit](const std::vector<Sensor>& places) {
    return LightInStates(room, fit, places);
  };
  light.top_m = [&room](double x, double y) { return TopAt(room, x, y); };
  light.states = states;
  light.bounds = room.scene.Bounds();
  light.relative_sigma = PredictionSigma(fit);
  const bool is_other = fit.absolute && !fit.is_scaled_by_readings;
  light.scale = is_other ? ScaleSource::kOther : ScaleSource::kReadings;
  return light;
}

}  // namespace luxfit
