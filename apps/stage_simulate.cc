#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/given_luminaire.h"
#include "apps/input_error.h"
#include "apps/stages.h"
#include "apps/suggest.h"
#include "forward/colour_illuminance.h"
#include "forward/luminaire_body.h"
#include "forward/placement.h"
#include "inverse/luxmeter_check.h"

namespace luxfit {
namespace {

using nlohmann::json;

// A patch twice as fine as the fit's costs a second here and nothing is repeated: behind a thin partition,
// where a patch of 0.4 m reaches from the light into the shade, it takes the error from 15 % to 1 %.
constexpr double kPatchSizeM = 0.2;
constexpr int kMaxPatches = 5000;  // 100 MB of coupling, a second of factorisation
// Below this the whole luminaire counts as in the room: quadrature weights are rounded.
constexpr double kAnyShare = 1e-6;

std::runtime_error MissingKey(const Session& session, size_t index, const std::string& key,
                              const std::string& message) {
  const SessionLuminaire& given = session.luminaires[index];
  if (given.line == 0) {
    return InputError({session.path, 0}, "luminaire",
                      "expected a [[luminaire]] with id = " + Quoted(given.id) +
                          ", which [states] names, got none; simulate needs its position_m and photometry");
  }
  return InputError({session.path, given.line}, "luminaire[" + std::to_string(index) + "]." + key, message);
}

// Everything that light needs must be given: nothing is estimated here.
void ExpectGiven(const Session& session) {
  if (session.luminaires.empty())
    throw InputError({session.path, 0}, "luminaire", "expected at least one [[luminaire]], got none; add it");
  for (size_t k = 0; k < session.luminaires.size(); ++k) {
    const SessionLuminaire& given = session.luminaires[k];
    if (given.line == 0 || !given.position_m)
      throw MissingKey(session, k, "position_m",
                       "expected a position, got nothing; add position_m = [x, y, z]");
    if (given.photometry == "auto")
      throw MissingKey(
          session, k, "photometry",
          "expected a distribution, got \"auto\": simulate estimates nothing; give a file (.ies, "
          ".ldt), \"isotropic\", \"lambertian\" or \"cosine_power\"");
    if (given.photometry == "cosine_power" && !given.cosine_exponent)
      throw MissingKey(
          session, k, "cosine_exponent",
          "expected the exponent of the cosine-power lobe, got nothing; add cosine_exponent = 3");
    if (!given.flux_lm && given.photometry_path.empty())
      throw MissingKey(session, k, "flux_lm", "expected a flux, got nothing; add flux_lm = 3000");
  }
  if (session.luxmeter.readings.empty())
    throw InputError(
        {session.path, 0}, "luxmeter.readings",
        "expected places to predict, got none; add [luxmeter] with a table whose lux may be empty");
}

Eigen::Matrix3Xd AlbedoOf(const Session& session, const Scene& scene) {
  Eigen::Matrix3Xd albedo(3, static_cast<Eigen::Index>(scene.materials.size()));
  std::vector<std::string> missing;
  for (size_t m = 0; m < scene.materials.size(); ++m) {
    if (scene.materials[m] == kLuminaireBodyMaterial) {
      albedo.col(static_cast<Eigen::Index>(m)).setZero();
      continue;
    }
    const auto known = session.scene->known_albedo_rgb.find(scene.materials[m]);
    if (known == session.scene->known_albedo_rgb.end()) {
      missing.push_back(Quoted(scene.materials[m]));
    } else {
      albedo.col(static_cast<Eigen::Index>(m)) = known->second;
    }
  }
  if (!missing.empty())
    throw InputError({session.path, session.scene->line}, "scene.albedo",
                     "expected a reflectance for every material of the mesh, got none for " +
                         ListNames(missing) + "; add a line such as " + missing.front() + " = 0.5");
  return albedo;
}

std::vector<Luminaire> LuminairesOf(const Session& session, RunContext& context) {
  ExpectGiven(session);
  std::vector<Luminaire> luminaires;
  for (size_t k = 0; k < session.luminaires.size(); ++k) {
    const GivenLuminaire known = ReadGivenLuminaire(session.luminaires[k]);
    const Luminaire& luminaire = known.luminaire;
    const bool flat =
        luminaire.shape == LuminaireShape::kDisc || luminaire.shape == LuminaireShape::kRectangle;
    if (flat && !(luminaire.size_m[0] > 0))
      throw MissingKey(session, k, "size_m",
                       "expected the size of a " + ToString(luminaire.shape) + ", got nothing; add size_m");
    RecordGivenPhotometry(known, context);
    luminaires.push_back(luminaire);
  }
  return luminaires;
}

class Simulation {
 public:
  Simulation(const Session& session, RunContext& context)
      : session_(session),
        context_(context),
        luminaires_(LuminairesOf(session, context)),
        room_(LoadRoom(session, context, {kPatchSizeM, kMaxPatches, luminaires_})),
        albedo_rgb_(AlbedoOf(session, room_.scene)) {
    WarnOfUnknownMaterials();
    context.choices.push_back(
        {"bodies of luminaires",
         "opaque, black",
         {"opaque, black", "none"},
         "flat luminaires that shine to one side shade and absorb; others are left out"});
  }

  json Run() {
    {
      const StageTimer timer(
          context_, "simulate",
          fmt::format("{} luminaires, {} readings", luminaires_.size(), session_.luxmeter.readings.size()));
      Compute();
      for (size_t k = 0; k < luminaires_.size(); ++k) WarnOfPlace(k);
    }
    WriteText(context_.out + "/illuminance.csv", Csv());
    json artifact = Artifact();
    WriteJson(context_.out + "/stages/simulate.json", artifact);
    return artifact;
  }

 private:
  struct Row {
    double lx = 0, direct_lx = 0;
  };

  void WarnOfUnknownMaterials() const {
    const std::vector<std::string>& materials = room_.scene.materials;
    if (!session_.scene) return;
    for (const auto& [name, albedo] : session_.scene->known_albedo_rgb) {
      if (std::count(materials.begin(), materials.end(), name) > 0) continue;
      context_.warnings.push_back({"unknown_material",
                                   fmt::format("scene.albedo.{}: the mesh has no such material", name),
                                   "remove it, or correct the name" + DidYouMean(name, materials)});
    }
  }

  void Compute() {
    std::vector<Sensor> sensors;
    for (const SessionReading& reading : session_.luxmeter.readings) {
      const Sensor sensor{reading.position_m, reading.normal, session_.luxmeter.response};
      const auto known = std::find(sensors.begin(), sensors.end(), sensor);
      sensor_of_.push_back(static_cast<Eigen::Index>(known - sensors.begin()));
      if (known == sensors.end()) sensors.push_back(sensor);
    }
    const Receivers receivers = MakeReceivers(room_, {}, sensors);
    const LuminaireVisibility visibility = ComputeVisibility(room_, receivers, luminaires_);
    const Eigen::Vector3d weights = session_.cameras.empty() ? Eigen::Vector3d(0.265, 0.670, 0.065)
                                                             : session_.cameras[0].luminance_weights;
    light_ = ComputeColourIlluminance(room_, receivers, visibility, luminaires_, albedo_rgb_, weights);
    context_.choices.push_back({"colour",
                                light_.solved_channels > 1 ? "rgb" : "luminance",
                                {"luminance", "rgb"},
                                "every channel whose reflectances differ has its own interreflection"});
    for (size_t i = 0; i < session_.luxmeter.readings.size(); ++i) rows_.push_back(RowOf(i));
  }

  double DimmingOf(size_t luminaire, const std::string& state) const {
    for (const SessionState& s : session_.states) {
      if (s.id != state) continue;
      const auto on = s.dimming.find(luminaires_[luminaire].id);
      return on == s.dimming.end() ? 0 : on->second;
    }
    return 0;
  }

  Row RowOf(size_t reading) const {
    Row row;
    for (size_t k = 0; k < luminaires_.size(); ++k) {
      const double lm = luminaires_[k].flux_lm * DimmingOf(k, session_.luxmeter.readings[reading].state);
      row.lx += lm * static_cast<double>(light_.total(sensor_of_[reading], static_cast<Eigen::Index>(k)));
      row.direct_lx +=
          lm * static_cast<double>(light_.direct(sensor_of_[reading], static_cast<Eigen::Index>(k)));
    }
    return row;
  }

  void WarnOfPlace(size_t k) {
    if (room_.scene.facets.empty()) return;
    const Luminaire& luminaire = luminaires_[k];
    const double share = ShareOutsideRoom(room_.rays, luminaire);
    if (share < kAnyShare) return;
    int on = 0, unlit = 0;
    for (size_t i = 0; i < session_.luxmeter.readings.size(); ++i) {
      if (DimmingOf(k, session_.luxmeter.readings[i].state) == 0) continue;
      ++on;
      unlit += light_.direct(sensor_of_[i], static_cast<Eigen::Index>(k)) == 0;
    }
    context_.warnings.push_back(
        {"luminaire_outside",
         fmt::format(
             "luminaire {} at ({:g}, {:g}, {:g}) m lies {}inside a solid, outside the room or on the far "
             "side of a wall: rays from there meet the backs of surfaces, or nothing; {} of its {} readings "
             "get "
             "no direct light from it",
             luminaire.id, luminaire.position.x(), luminaire.position.y(), luminaire.position.z(),
             share > 1 - kAnyShare ? "" : fmt::format("to {:.0f} % of its surface ", 100 * share), unlit, on),
         "check position_m and scene.unit; a recessed luminaire belongs just below the ceiling's surface; a "
         "facet "
         "whose corners run clockwise seen from inside the room has its front on the wrong side"});
  }

  std::string Csv() const {
    std::string text = "id,state,lux,direct_lux,indirect_lux\n";
    const auto field = [](const std::string& value) {
      if (value.find_first_of(",\"\n") == std::string::npos) return value;
      std::string quoted = "\"";
      for (const char c : value) quoted += c == '"' ? "\"\"" : std::string(1, c);
      return quoted + "\"";
    };
    for (size_t i = 0; i < rows_.size(); ++i) {
      const SessionReading& reading = session_.luxmeter.readings[i];
      text += fmt::format("{},{},{:.6g},{:.6g},{:.6g}\n", field(reading.id), field(reading.state),
                          rows_[i].lx, rows_[i].direct_lx, rows_[i].lx - rows_[i].direct_lx);
    }
    return text;
  }

  json LuminairesJson() const {
    json list = json::array();
    for (size_t k = 0; k < luminaires_.size(); ++k) {
      const Luminaire& l = luminaires_[k];
      list.push_back({{"id", l.id},
                      {"position_m", {l.position.x(), l.position.y(), l.position.z()}},
                      {"aim", {l.aim.x(), l.aim.y(), l.aim.z()}},
                      {"heading", {l.heading.x(), l.heading.y(), l.heading.z()}},
                      {"photometry", session_.luminaires[k].photometry},
                      {"shape", ToString(l.shape)},
                      {"size_m", {l.size_m[0], l.size_m[1]}},
                      {"flux_lm", l.flux_lm},
                      {"flux_source", session_.luminaires[k].flux_lm ? "session" : "file"}});
    }
    return list;
  }

  void AddReadings(json& artifact) const {
    std::vector<CheckedReading> checked;
    artifact["luxmeter"] = json::array();
    for (size_t i = 0; i < rows_.size(); ++i) {
      const SessionReading& reading = session_.luxmeter.readings[i];
      artifact["luxmeter"].push_back(
          {{"id", reading.id},
           {"state", reading.state},
           {"measured_lux", reading.is_measured ? json(reading.illuminance_lx) : json()},
           {"predicted_lux", rows_[i].lx},
           {"direct_lux", rows_[i].direct_lx},
           {"indirect_lux", rows_[i].lx - rows_[i].direct_lx}});
      if (reading.is_measured) checked.push_back({reading.illuminance_lx, rows_[i].lx, 0, 0});
    }
    const LuxmeterSummary summary = SummarizeLuxmeter(checked);
    artifact["summary"] = {{"mean_abs_error_lux", summary.mean_abs_error_lx},
                           {"mean_abs_error_percent", summary.mean_abs_error_percent},
                           {"max_abs_error_percent", summary.max_abs_error_percent},
                           {"readings_checked", summary.readings_checked}};
  }

  json Artifact() const {
    json artifact = ProvenanceJson("luxfit-simulate-1", context_.provenance);
    artifact["session"] = session_.name;
    artifact["luminaires"] = LuminairesJson();
    artifact["materials"] = json::array();
    for (size_t m = 0; m < room_.scene.materials.size(); ++m) {
      if (room_.scene.materials[m] == kLuminaireBodyMaterial) continue;
      const Eigen::Vector3d rgb = albedo_rgb_.col(static_cast<Eigen::Index>(m));
      artifact["materials"].push_back(
          {{"name", room_.scene.materials[m]}, {"albedo_rgb", {rgb.x(), rgb.y(), rgb.z()}}});
    }
    AddReadings(artifact);
    artifact["choices"] = ChoicesJson(context_);
    artifact["warnings"] = WarningsJson(context_);
    artifact["timing_s"] = context_.timing_s;
    artifact["model"] = {{"patches", room_.patches.patches.size()},
                         {"elements", room_.patches.elements.size()},
                         {"rays_per_element", FormFactorOptions{}.rays_per_element},
                         {"rays_escaped_fraction", room_.form_factors.escaped_fraction},
                         {"rays_back_fraction", room_.form_factors.back_fraction},
                         {"channels", light_.solved_channels},
                         {"bounces", "all"}};
    return artifact;
  }

  const Session& session_;
  RunContext& context_;
  std::vector<Luminaire> luminaires_;
  Room room_;
  Eigen::Matrix3Xd albedo_rgb_;
  std::vector<Eigen::Index> sensor_of_;  // by reading: several states share a place
  ColourIlluminance light_;
  std::vector<Row> rows_;
};

}  // namespace

json SimulateSession(const Session& session, RunContext& context) {
  return Simulation(session, context).Run();
}

}  // namespace luxfit
