#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/export/exports.h"
#include "apps/export/radiance_scene.h"
#include "apps/stages/simulate/given_session.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_text.h"
#include "forward/room/one_line.h"

namespace luxfit {
namespace {

std::vector<std::string> StateIds(const Session& session) {
  std::vector<std::string> ids;
  for (const SessionState& state : session.states) ids.push_back(state.id);
  return ids;
}

std::vector<std::string> LuminaireStems(const FittedRoom& fitted) {
  std::vector<std::string> ids;
  for (const Luminaire& luminaire : fitted.luminaires) ids.push_back("luminaire_" + luminaire.id);
  return DistinctFileStems(ids);
}

// Writes the luminaires of a state, dimmed.
std::string StateText(const FittedRoom& fitted, const std::string& state,
                      const std::vector<std::string>& stems) {
  const Eigen::VectorXd dimming = DimmingOf(fitted, state);
  std::string text;
  for (size_t k = 0; k < fitted.luminaires.size(); ++k)
    text += RadianceSceneOf(fitted.luminaires[k], stems[k], dimming[static_cast<Eigen::Index>(k)]).scene;
  return text;
}

Eigen::Matrix3Xd Grey(const FittedRoom& fitted) {
  Eigen::Matrix3Xd grey(3, fitted.albedo.size());
  for (Eigen::Index m = 0; m < fitted.albedo.size(); ++m) grey.col(m).setConstant(fitted.albedo[m]);
  return grey;
}

// Returns reflectances by colour where they were estimated.
Eigen::Matrix3Xd Coloured(const FittedRoom& fitted) {
  Eigen::Matrix3Xd rgb = Grey(fitted);
  const auto& names = fitted.room.scene.materials;
  for (const nlohmann::json& material : fitted.result->at("materials")) {
    const auto at = std::find(names.begin(), names.end(), material.at("name"));
    const nlohmann::json& known = material.at("albedo_rgb");
    if (at == names.end() || !known.is_array()) continue;
    for (Eigen::Index i = 0; i < 3; ++i) rgb(i, at - names.begin()) = known[static_cast<size_t>(i)];
  }
  return rgb;
}

std::string PointLines(const ReadingPlaces& places) {
  std::string text;
  for (const Sensor& sensor : places.sensors) {
    const Eigen::Vector3d p = RayOrigin(sensor);
    text += fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.6f} {:.6f}\n", p.x(), p.y(), p.z(), sensor.normal.x(),
                        sensor.normal.y(), sensor.normal.z());
  }
  return text;
}

// Writes the predictions of luxfit itself at the points: one line for each point, one column for each state.
std::string PredictionCsv(const FittedRoom& fitted, const ReadingPlaces& places) {
  const std::vector<std::string> states = StateIds(fitted.session);
  std::vector<std::string> fields{"id"};
  for (const std::string& state : states) fields.push_back(CsvField("lux of " + state));
  std::string text = CsvLine(fields);
  const PlaceLight light = fitted.light->LightAt(places.sensors);
  std::vector<Eigen::VectorXd> lux;  // by state
  lux.reserve(states.size());
  for (const std::string& state : states) lux.push_back(light.Under(DimmingOf(fitted, state)));
  for (size_t i = 0; i < places.sensors.size(); ++i) {
    const Eigen::Index row = static_cast<Eigen::Index>(i);
    const auto& of = places.sensor_of_reading;
    const auto reading = std::find(of.begin(), of.end(), row) - of.begin();
    fields = {CsvField(fitted.session.luxmeter.readings[static_cast<size_t>(reading)].id)};
    for (const Eigen::VectorXd& of_state : lux) fields.push_back(CsvField(of_state[row]));
    text += CsvLine(fields);
  }
  return text;
}

std::string Readme(const FittedRoom& fitted, const std::string& state_stem) {
  return fmt::format(
      R"(The room of session {} as luxfit fitted it, for Radiance. Lengths m, z up; 179 lm/W. Run in this folder.

  materials.rad      reflectances as the fit took them, the same in all colours
  materials_rgb.rad  reflectances by colour where they were estimated; in place of materials.rad
  room.rad           surfaces
  state_STATE.rad    the luminaires that are on in a state, dimmed
  luminaire_ID.rad   one luminaire, fully on; luminaire_ID.dat its distribution, read by luxfit.cal
  luxmeter.pts       the luxmeter's points and directions, in the order of luxmeter_points.csv
  luxmeter_points.csv  what luxfit predicts there

Illuminance at those points, lx:
  oconv materials.rad room.rad state_{}.rad > scene.oct
  rtrace -h -I -ab 8 -ad 4096 -as 1024 -aa 0.08 -ar 512 -dj 0 -ds 0.05 -w scene.oct < luxmeter.pts |
    awk '{{ print 179 * (0.265 * $1 + 0.670 * $2 + 0.065 * $3) }}'

A picture of it (view as you like):
  rpict -vp 1 1 1.6 -vd 1 1 -0.2 -vu 0 0 1 -ab 4 scene.oct > scene.hdr
)",
      OneLine(fitted.session.name), state_stem);
}

}  // namespace

ExportedFiles ExportRadiance(const FittedRoom& fitted, const std::string& folder) {
  ExportedFiles exported;
  if (fitted.room.scene.facets.empty()) {
    exported.notes.push_back("the session has no mesh: there is no room to export to Radiance");
    return exported;
  }
  if (!fitted.is_absolute)
    exported.notes.push_back("the fit has no absolute scale: fluxes in the Radiance scene are relative ones");
  const auto write = [&](const std::string& name, const std::string& text) {
    WriteText(folder + "/" + name, text);
    exported.files.push_back(folder + "/" + name);
  };
  const std::vector<std::string> materials = DistinctFileStems(fitted.room.scene.materials);
  write("materials.rad", RadianceMaterials(materials, Grey(fitted)));
  write("materials_rgb.rad", RadianceMaterials(materials, Coloured(fitted)));
  write("room.rad", RadianceSurfaces(fitted.room.scene, materials));
  write("luxfit.cal", RadianceFunctions());
  const std::vector<std::string> stems = LuminaireStems(fitted);
  for (size_t k = 0; k < stems.size(); ++k) {
    const RadianceLuminaire text = RadianceSceneOf(fitted.luminaires[k], stems[k]);
    write(stems[k] + ".rad", text.scene);
    if (!text.table.empty()) write(stems[k] + ".dat", text.table);
  }
  const std::vector<std::string> states = StateIds(fitted.session), state_stems = DistinctFileStems(states);
  for (size_t s = 0; s < states.size(); ++s)
    write("state_" + state_stems[s] + ".rad", StateText(fitted, states[s], stems));
  if (!fitted.session.luxmeter.readings.empty()) {
    const ReadingPlaces places = PlacesOfReadings(fitted.session);
    write("luxmeter.pts", PointLines(places));
    write("luxmeter_points.csv", PredictionCsv(fitted, places));
  }
  write("README.txt", Readme(fitted, state_stems.empty() ? "all" : state_stems.back()));
  return exported;
}

}  // namespace luxfit
