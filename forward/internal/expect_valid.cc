#include "forward/internal/expect_valid.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace luxfit {
namespace {

void Expect(bool holds, const std::string& of, const char* what) {
  if (!holds) throw std::invalid_argument(of + ": expected " + what);
}

void ExpectLuminaire(const Luminaire& luminaire, const std::string& name) {
  Expect(luminaire.position.allFinite(), name, "a finite position");
  Expect(luminaire.aim.allFinite() && luminaire.aim.norm() > 0, name, "a finite aim other than 0");
  Expect(luminaire.heading.allFinite(), name, "a finite heading");
  Expect(luminaire.size_m.allFinite() && (luminaire.size_m.array() >= 0).all(), name, "a finite size >= 0");
  Expect(std::isfinite(luminaire.flux_lm), name, "a finite flux");
  Expect(luminaire.distribution != Distribution::kCosinePower ||
             (luminaire.cosine_exponent > 0 && std::isfinite(luminaire.cosine_exponent)),
         name, "a finite exponent above 0");
  Expect(luminaire.distribution != Distribution::kMeasured || luminaire.table != nullptr, name,
         "a table of intensities");
  Expect(luminaire.emission.size() == 0 ||
             ((luminaire.emission >= 0).all() && std::abs(luminaire.emission.sum() - 1) < 1e-6),
         name, "shares of cells >= 0 that sum to 1");
}

void ExpectSensor(const Sensor& sensor, const std::string& name) {
  Expect(sensor.position.allFinite(), name, "a finite position");
  Expect(sensor.normal.allFinite() && sensor.normal.norm() > 0, name, "a finite normal other than 0");
  Expect(sensor.response.facing.allFinite(), name, "a finite direction that it faces");
}

}  // namespace

void ExpectValid(const Scene& scene) {
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const Facet& facet = scene.facets[f];
    const std::string name = "facet " + std::to_string(f);
    Expect(facet.origin.allFinite() && facet.edge_u.allFinite() && facet.edge_v.allFinite(), name,
           "finite corners");
    Expect(facet.AreaM2() > 0, name, "an area above 0 (leave out facets that have none)");
    Expect(facet.material >= 0 && static_cast<size_t>(facet.material) < scene.materials.size(), name,
           "the index of one of the scene's materials");
  }
}

void ExpectValid(const Luminaire& luminaire) {
  ExpectLuminaire(luminaire, "luminaire \"" + luminaire.id + "\"");
}

void ExpectValid(const std::vector<Luminaire>& luminaires) {
  for (size_t k = 0; k < luminaires.size(); ++k)
    ExpectLuminaire(luminaires[k], "luminaire " + std::to_string(k) + " (\"" + luminaires[k].id + "\")");
}

void ExpectValid(const Sensor& sensor) { ExpectSensor(sensor, "sensor"); }

void ExpectValid(const std::vector<Sensor>& sensors) {
  for (size_t i = 0; i < sensors.size(); ++i) ExpectSensor(sensors[i], "sensor " + std::to_string(i));
}

}  // namespace luxfit
