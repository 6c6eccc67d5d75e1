#include <set>
#include <utility>

#include "apps/stages/degrade/degradation_rows.h"
#include "inverse/study/degrade.h"

namespace luxfit {
namespace {

using TraceKey = std::pair<std::string, double>;

std::optional<std::string> NeedsScene(const UndegradedSession& whole) {
  if (!whole.prepared.session.scene) return "the session has no scene to simulate";
  return std::nullopt;
}

std::optional<std::string> NeedsTwoLuminaires(const UndegradedSession& whole) {
  if (whole.refit.luminaires.size() < 2) return "fewer than two luminaires were found";
  return NeedsScene(whole);
}

// Returns the observed elements, each once.
std::vector<int> ElementsOf(const std::vector<Observation>& observations) {
  std::set<int> elements;
  for (const Observation& o : observations) elements.insert(o.element);
  return {elements.begin(), elements.end()};
}

// Replaces observations and readings by those of that light; its luminaires are the truth.
void Simulate(UndegradedSession& whole, const TraceKey& key, const LightState& light, std::mt19937_64& rng,
              DegradedCase& c) {
  const std::vector<Reading>& readings = whole.refit.fit.data.readings;
  if (whole.traced.count(key) == 0)
    whole.traced[key] =
        TraceLight(whole.prepared.room, ElementsOf(whole.observed.observations), readings, light);
  const LightData data = SimulateLight(whole.prepared.room, whole.traced.at(key), light,
                                       whole.refit.fit.data.dimming, readings, rng);
  c.observed = {};  // simulated light has no pictures
  c.observed.observations = data.observations;
  for (size_t r = 0; r < data.readings.size(); ++r) {
    c.linearized.readings[r].illuminance_lx = data.readings[r].illuminance_lx;
    c.linearized.readings[r].ambient_lx = 0;
  }
  for (size_t m = 0; m < whole.prepared.room.scene.materials.size(); ++m) {
    const auto known = c.session.scene->known_albedo_rgb.find(whole.prepared.room.scene.materials[m]);
    if (known != c.session.scene->known_albedo_rgb.end())
      known->second.setConstant(light.albedo[static_cast<Eigen::Index>(m)]);
  }
  c.truth.clear();
  for (size_t k = 0; k < light.luminaires.size(); ++k) {
    const Luminaire& luminaire = light.luminaires[k];
    if (k < c.session.luminaires.size() && c.session.luminaires[k].position_m)
      c.session.luminaires[k].position_m = luminaire.position;
    c.truth.push_back({luminaire.id, luminaire.position, Eigen::Vector3d::Zero(), luminaire.flux_lm, 0});
  }
}

void MoveTogether(UndegradedSession& whole, double distance_m, std::mt19937_64& rng, DegradedCase& c) {
  LightState light = whole.refit.fit.fit.state;
  light.luminaires = WithLuminairesTogether(light.luminaires, distance_m);
  Simulate(whole, {"luminaires_together", distance_m}, light, rng, c);
}

void RaiseAlbedo(UndegradedSession& whole, double percent, std::mt19937_64& rng, DegradedCase& c) {
  LightState light = whole.refit.fit.fit.state;
  light.albedo = WithRaisedAlbedo(light.albedo, percent / 100);
  Simulate(whole, {"albedo_raised", percent}, light, rng, c);
}

}  // namespace

Degradation LuminairesTogether() {
  const std::vector<double> levels = {1, 0.5, 0.25, 0.1, 0.05};
  return {"luminaires_together", "m",         "distance of the nearest two luminaires, m", levels, true,
          NeedsTwoLuminaires,    MoveTogether};
}

Degradation AlbedoRaised() {
  const std::vector<double> levels = {0, 30, 60, 80, 95};
  return {"albedo_raised", "%",        "reflectances raised, % of the way to 0.95", levels, false,
          NeedsScene,      RaiseAlbedo};
}

}  // namespace luxfit
