#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/patch_light.h"
#include "apps/stages/session_light.h"
#include "apps/stages/simulate/given_session.h"
#include "forward/light/choose_accuracy.h"
#include "forward/room/threads.h"

namespace luxfit {
namespace {

namespace py = pybind11;

// Holds the light of a session that gives everything, by luminaire at full flux.
struct Simulation {
  GivenScene given;
  AccuracyChoice accuracy;
  std::optional<SceneLight> scene_light;  // always set; SceneLight has no empty state
  PatchLight patches;
  Eigen::VectorXd flux_lm;
  Eigen::MatrixXd dimming_of_reading;  // readings x luminaires
  std::vector<std::string> luminaire_ids;
};

Eigen::MatrixXd AtFullFlux(const Eigen::MatrixXf& per_lumen, const Eigen::VectorXd& flux_lm) {
  return per_lumen.cast<double>() * flux_lm.asDiagonal();
}

Eigen::MatrixXd DimmingOfReadings(const Session& session) {
  const std::vector<SessionReading>& readings = session.luxmeter.readings;
  const std::vector<Eigen::VectorXd> by_state = DimmingOf(session);
  Eigen::MatrixXd dimming = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(readings.size()),
                                                  static_cast<Eigen::Index>(session.luminaires.size()));
  for (size_t i = 0; i < readings.size(); ++i) {
    for (size_t s = 0; s < by_state.size(); ++s)
      if (session.states[s].id == readings[i].state) dimming.row(static_cast<Eigen::Index>(i)) = by_state[s];
  }
  return dimming;
}

Simulation Simulate(const Session& session, double error_percent, int threads) {
  const ThreadLimit limit(threads);
  RunContext context;
  Simulation result;
  result.given = ReadGivenScene(session, "simulate", context);
  AccuracyOptions options;
  options.error_percent = error_percent;
  AccurateSceneLight accurate = ChooseAccuracy(result.given.lit, options);
  result.accuracy = std::move(accurate.choice);
  result.scene_light.emplace(std::move(accurate.light));
  const std::vector<Luminaire>& luminaires = result.given.lit.luminaires;
  result.flux_lm = FluxesLm(luminaires);
  for (const Luminaire& luminaire : luminaires) result.luminaire_ids.push_back(luminaire.id);
  result.patches = ComputePatchLight(result.scene_light->room, luminaires, result.given.lit.albedo_rgb,
                                     result.given.lit.channel_weights);
  result.dimming_of_reading = DimmingOfReadings(session);
  return result;
}

// Returns one row of `by_place` for each reading, dimmed.
Eigen::VectorXd AtReadings(const Simulation& s, const Eigen::MatrixXf& by_place) {
  const Eigen::MatrixXd full = AtFullFlux(by_place, s.flux_lm);
  Eigen::VectorXd lx(s.dimming_of_reading.rows());
  for (Eigen::Index i = 0; i < lx.size(); ++i)
    lx[i] =
        full.row(s.given.places.sensor_of_reading[static_cast<size_t>(i)]).dot(s.dimming_of_reading.row(i));
  return lx;
}

py::dict PatchesOf(const Simulation& s) {
  py::dict dict = PatchArrays(s.scene_light->room.patches);
  dict["materials"] = s.scene_light->room.scene.materials;
  dict["illuminance_lx"] = s.patches.illuminance_lx;
  dict["exitance_lm_m2"] = s.patches.exitance_lm_m2;
  return dict;
}

}  // namespace

void BindSimulation(py::module_& module) {
  py::class_<Simulation>(
      module, "Simulation",
      "Light of a session that gives everything (simulate). Columns are luminaires at full flux: "
      "light adds, so that any state is illuminance_lx @ dimming.")
      .def_readonly("luminaire_ids", &Simulation::luminaire_ids)
      .def_readonly("flux_lm", &Simulation::flux_lm, "(K,)")
      .def_property_readonly(
          "sensor_position_m",
          [](const Simulation& s) { return MemberRows(s.given.places.sensors, &Sensor::position); },
          "(S, 3): the places of the readings, each once.")
      .def_property_readonly(
          "sensor_normal",
          [](const Simulation& s) { return MemberRows(s.given.places.sensors, &Sensor::normal); }, "(S, 3)")
      .def_property_readonly(
          "illuminance_lx",
          [](const Simulation& s) { return AtFullFlux(s.scene_light->light.total, s.flux_lm); },
          "(S, K), at those places.")
      .def_property_readonly(
          "direct_lx", [](const Simulation& s) { return AtFullFlux(s.scene_light->light.direct, s.flux_lm); },
          "(S, K), its direct part.")
      .def_property_readonly(
          "sensor_of_reading", [](const Simulation& s) { return s.given.places.sensor_of_reading; },
          "Index of its place for every reading of the session.")
      .def_property_readonly(
          "reading_lx", [](const Simulation& s) { return AtReadings(s, s.scene_light->light.total); },
          "(n,): predicted for every reading of the session, in its state.")
      .def_property_readonly(
          "reading_direct_lx", [](const Simulation& s) { return AtReadings(s, s.scene_light->light.direct); },
          "(n,), its direct part.")
      .def_property_readonly("patches", &PatchesOf,
                             "dict: center_m, normal (P, 3), area_m2, material (P,) as index of materials, "
                             "vertices_m (P, 4, 3), "
                             "illuminance_lx and exitance_lm_m2 (P, K); luminance in cd/m2 is exitance / pi.")
      .def_property_readonly(
          "estimated_error_percent", [](const Simulation& s) { return s.accuracy.estimated_error_percent; },
          "Of the illuminance at the readings' places, root mean square.");
  module.def(
      "simulate",
      [](const Session& session, double error_percent, int threads) {
        if (!(error_percent > 0)) throw std::runtime_error("simulate: error_percent: expected a number > 0");
        const py::gil_scoped_release release;
        return Simulate(session, error_percent, threads);
      },
      py::arg("session"), py::kw_only(), py::arg("error_percent") = 1.0, py::arg("threads") = 0,
      "Illuminance and patches of a session that gives every reflectance and of every luminaire position, "
      "photometry "
      "and flux; patches, rays and bounces are chosen for that error. Raises InputError for what is "
      "missing.");
}

}  // namespace luxfit
