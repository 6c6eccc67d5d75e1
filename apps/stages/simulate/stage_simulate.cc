#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/stages/check/check_report.h"
#include "apps/stages/check/session_check.h"
#include "apps/stages/simulate/accuracy_choices.h"
#include "apps/stages/simulate/given_session.h"
#include "apps/stages/stages.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/input_error.h"
#include "forward/direct/luminaire_body.h"
#include "inverse/check/luxmeter_check.h"

namespace luxfit {
namespace {

using nlohmann::json;

// Below this share outside, the whole luminaire counts as inside, since quadrature weights are rounded.
constexpr double kAnyShare = 1e-6;

void ExpectReadings(const Session& session) {
  if (session.luxmeter.readings.empty())
    throw InputError({session.path, 0}, "luxmeter.readings",
                     "expected places to predict, got none; add [luxmeter] with a table whose illuminance_lx "
                     "may be empty");
}

class Simulation {
 public:
  Simulation(const Session& session, double error_percent, RunContext& context)
      : session_(session),
        context_(context),
        given_(ReadGivenScene(session, "simulate", context)),
        error_percent_(error_percent) {
    ExpectReadings(session);
    WarnOfUnknownMaterials(session_, given_.lit.scene.materials, context_);
  }

  json Run() {
    {
      const StageTimer timer(context_, "simulate",
                             fmt::format("{} luminaires, {} readings", given_.lit.luminaires.size(),
                                         session_.luxmeter.readings.size()));
      Compute();
      for (size_t k = 0; k < given_.lit.luminaires.size(); ++k) WarnOfPlace(k);
    }
    WriteText(context_.out + "/illuminance.csv", Csv());
    json artifact = Artifact();
    WriteJson(context_.out + "/stages/simulate.json", artifact);
    return artifact;
  }

 private:
  struct Row {
    bool is_outside = false;  // the reading is not in the room: nothing is predicted
    double lx = 0, direct_lx = 0;
  };

  void Compute() {
    AccuracyOptions options;
    options.error_percent = error_percent_;
    AccurateSceneLight accurate = ChooseAccuracy(given_.lit, options);
    choice_ = std::move(accurate.choice);
    scene_light_.emplace(std::move(accurate.light));
    RecordAccuracy(choice_, static_cast<int>(scene_light_->room.patches.patches.size()), error_percent_,
                   context_);
    WarnOfMesh(given_.findings, scene_light_->room, context_);
    context_.choices.push_back({"colour",
                                Light().solved_channels > 1 ? "rgb" : "luminance",
                                {"luminance", "rgb"},
                                "every channel whose reflectances differ has its own interreflection"});
    const ReadingsOutside places = FindReadingsOutside(session_, scene_light_->room.rays);
    context_.warnings.insert(context_.warnings.end(), places.warnings.begin(), places.warnings.end());
    for (size_t i = 0; i < session_.luxmeter.readings.size(); ++i) {
      rows_.push_back(RowOf(i));
      rows_.back().is_outside = places.lines.count(session_.luxmeter.readings[i].line) > 0;
    }
  }

  const ColourIlluminance& Light() const { return scene_light_->light; }

  double DimmingOf(size_t luminaire, const std::string& state) const {
    for (const SessionState& s : session_.states) {
      if (s.id != state) continue;
      const auto on = s.dimming.find(given_.lit.luminaires[luminaire].id);
      return on == s.dimming.end() ? 0 : on->second;
    }
    return 0;
  }

  Row RowOf(size_t reading) const {
    Row row;
    for (size_t k = 0; k < given_.lit.luminaires.size(); ++k) {
      const double lm =
          given_.lit.luminaires[k].flux_lm * DimmingOf(k, session_.luxmeter.readings[reading].state);
      row.lx += lm * static_cast<double>(Light().total(given_.places.sensor_of_reading[reading],
                                                       static_cast<Eigen::Index>(k)));
      row.direct_lx += lm * static_cast<double>(Light().direct(given_.places.sensor_of_reading[reading],
                                                               static_cast<Eigen::Index>(k)));
    }
    return row;
  }

  void WarnOfPlace(size_t k) {
    if (scene_light_->room.scene.facets.empty()) return;
    const Luminaire& luminaire = given_.lit.luminaires[k];
    const double share = ShareOutsideRoom(scene_light_->room.rays, luminaire);
    if (share < kAnyShare) return;
    int on = 0, unlit = 0;
    for (size_t i = 0; i < session_.luxmeter.readings.size(); ++i) {
      if (DimmingOf(k, session_.luxmeter.readings[i].state) == 0) continue;
      ++on;
      unlit += Light().direct(given_.places.sensor_of_reading[i], static_cast<Eigen::Index>(k)) == 0;
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
    std::string text = "id,state,illuminance_lx,direct_lx,indirect_lx\n";
    for (size_t i = 0; i < rows_.size(); ++i) {
      const SessionReading& reading = session_.luxmeter.readings[i];
      text += CsvField(reading.id) + "," + CsvField(reading.state);
      text += rows_[i].is_outside ? ",,,\n"
                                  : fmt::format(",{:.6g},{:.6g},{:.6g}\n", rows_[i].lx, rows_[i].direct_lx,
                                                rows_[i].lx - rows_[i].direct_lx);
    }
    return text;
  }

  json LuminairesJson() const {
    json list = json::array();
    for (size_t k = 0; k < given_.lit.luminaires.size(); ++k) {
      const Luminaire& l = given_.lit.luminaires[k];
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

  static json Predicted(const Row& row, double lx) { return row.is_outside ? json() : json(lx); }

  void AddReadings(json& artifact) const {
    std::vector<CheckedReading> checked;
    artifact["luxmeter"] = json::array();
    for (size_t i = 0; i < rows_.size(); ++i) {
      const SessionReading& reading = session_.luxmeter.readings[i];
      artifact["luxmeter"].push_back(
          {{"id", reading.id},
           {"state", reading.state},
           {"measured_lx", reading.is_measured ? json(reading.illuminance_lx) : json()},
           {"predicted_lx", Predicted(rows_[i], rows_[i].lx)},
           {"direct_lx", Predicted(rows_[i], rows_[i].direct_lx)},
           {"indirect_lx", Predicted(rows_[i], rows_[i].lx - rows_[i].direct_lx)}});
      if (reading.is_measured && !rows_[i].is_outside)
        checked.push_back({reading.illuminance_lx, rows_[i].lx, 0, 0});
    }
    artifact["summary"] = SummaryJson(SummarizeLuxmeter(checked));
  }

  json Artifact() const {
    json artifact = ProvenanceJson("luxfit-simulate-1", context_.provenance);
    artifact["session"] = session_.name;
    artifact["luminaires"] = LuminairesJson();
    artifact["materials"] = json::array();
    for (size_t m = 0; m < scene_light_->room.scene.materials.size(); ++m) {
      if (scene_light_->room.scene.materials[m] == kLuminaireBodyMaterial) continue;
      const Eigen::Vector3d rgb = given_.lit.albedo_rgb.col(static_cast<Eigen::Index>(m));
      artifact["materials"].push_back(
          {{"name", scene_light_->room.scene.materials[m]}, {"albedo_rgb", {rgb.x(), rgb.y(), rgb.z()}}});
    }
    AddReadings(artifact);
    AddStatus(context_, artifact);
    artifact["error_percent_asked"] = error_percent_;
    artifact["estimated_error_percent"] = choice_.estimated_error_percent;
    artifact["choices"] = ChoicesJson(context_);
    artifact["warnings"] = WarningsJson(context_);
    artifact["timing_s"] = context_.timing_s;
    artifact["model"] = {
        {"patches", scene_light_->room.patches.patches.size()},
        {"elements", scene_light_->room.patches.elements.size()},
        {"rays_per_element", choice_.options.room.form_factors.rays_per_element},
        {"rays_escaped_fraction", scene_light_->room.form_factors.escaped_fraction},
        {"rays_back_fraction", scene_light_->room.form_factors.back_fraction},
        {"channels", Light().solved_channels},
        {"bounces", choice_.all_bounces ? json("all") : json(choice_.options.solver.bounces)}};
    return artifact;
  }

  const Session& session_;
  RunContext& context_;
  GivenScene given_;
  double error_percent_;
  AccuracyChoice choice_;
  std::optional<SceneLight> scene_light_;  // made by that choice
  std::vector<Row> rows_;
};

}  // namespace

json SimulateSession(const Session& session, double error_percent, RunContext& context) {
  return Simulation(session, error_percent, context).Run();
}

}  // namespace luxfit
