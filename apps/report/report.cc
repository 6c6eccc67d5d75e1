#include "apps/report/report.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/export/fit_uncertainty.h"
#include "apps/report/report_page.h"
#include "apps/report/report_places.h"
#include "apps/report/report_room.h"
#include "apps/report/report_views.h"
#include "apps/report/shown_paths.h"
#include "apps/session/report_details.h"
#include "apps/session/session_scene.h"
#include "apps/stages/linearize/linearize.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"
#include "apps/version.h"

namespace luxfit {
namespace {

using nlohmann::json;

json StatesJson(const FittedRoom& fitted) {
  json states = json::array();
  for (const SessionState& state : fitted.session.states) {
    const Eigen::VectorXd dimming = DimmingOf(fitted, state.id);
    states.push_back({{"id", state.id}, {"dimming", std::vector<double>(dimming.begin(), dimming.end())}});
  }
  return states;
}

// Returns the largest ambient light that was subtracted from a reading; null where none was measured.
json AmbientJson(const Session& session) {
  json most_lx;
  for (const SessionState& state : session.states) {
    if (!IsAmbient(session, state)) continue;
    for (const SessionReading& reading : session.luxmeter.readings) {
      if (reading.state != state.id || !reading.is_measured) continue;
      most_lx = most_lx.is_null() ? reading.illuminance_lx
                                  : std::max(most_lx.get<double>(), reading.illuminance_lx);
    }
  }
  return most_lx;
}

// Returns the conditions of the measurement.
json ConditionsJson(const FittedRoom& fitted) {
  const Session& session = fitted.session;
  json photos = json::array();
  for (const SessionPhoto& photo : session.photos)
    photos.push_back({{"view", photo.view},
                      {"state", photo.state},
                      {"camera", session.cameras[static_cast<size_t>(photo.camera)].id},
                      {"exposure_s", photo.exposure_s}});
  json cameras = json::array();
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const SessionCamera& camera = session.cameras[c];
    json entry = {{"id", camera.id}, {"response", camera.response}, {"vignetting", camera.vignetting}};
    if (c < fitted.registered.cameras.size())
      entry["size_px"] = {fitted.registered.cameras[c].width_px, fitted.registered.cameras[c].height_px};
    cameras.push_back(entry);
  }
  return {{"photos", photos},
          {"cameras", cameras},
          {"meter_class", session.luxmeter.meter_class},
          {"sensitivity",
           session.luxmeter.sensitivity_path.empty() ? "cosine" : session.luxmeter.sensitivity_path},
          {"ambient_lx", AmbientJson(session)},
          {"mesh", session.scene && !session.scene->outline ? json(session.scene->mesh) : json()},
          {"room", session.scene ? json(RoomText(*session.scene)) : json()},
          {"unit", session.scene ? json(session.scene->unit) : json()},
          {"tags", session.tags.survey.size()},
          {"tag_family", session.tags.family}};
}

json TasksJson() {
  json tasks = json::array();
  for (const LightingTask& task : LightingTasks())
    tasks.push_back({{"key", task.key},
                     {"name", task.name},
                     {"cylindrical_lx", task.cylindrical_lx},
                     {"wall_lx", task.wall_lx},
                     {"ceiling_lx", task.ceiling_lx},
                     {"average_lx", task.average_lx},
                     {"uniformity", task.uniformity},
                     {"ugr", task.ugr}});
  return tasks;
}

json DetailsJson(const ReportDetails& details) {
  return {{"title", details.title},
          {"client", details.client},
          {"address", details.address},
          {"author", details.author},
          {"date", details.date},
          {"meter", details.meter},
          {"meter_serial", details.meter_serial},
          {"meter_calibrated", details.meter_calibrated}};
}

// A targets file that has [report] alone keeps the default areas and observers.
ReportTargets AskedTargets(const FittedRoom& fitted, const ReportOptions& options) {
  ReportTargets standard = DefaultTargets(fitted.room.scene);
  if (options.targets_path.empty()) return standard;
  ReportTargets targets = ReadTargets(options.targets_path);
  if (!targets.areas.empty() || !targets.observers.empty()) return targets;
  targets.areas = standard.areas;
  targets.observers = standard.observers;
  return targets;
}

// Returns the power of each luminaire, W; null where the targets do not give it.
json PowersJson(const FittedRoom& fitted, const ReportTargets& targets) {
  std::vector<std::string> ids;
  ids.reserve(fitted.luminaires.size());
  for (const Luminaire& luminaire : fitted.luminaires) ids.push_back(luminaire.id);
  json powers(std::vector<json>(ids.size()));
  for (const LuminairePower& one : targets.powers) {
    const auto found = std::find(ids.begin(), ids.end(), one.id);
    if (found == ids.end())
      throw InputError({targets.path, one.line}, "power_w." + one.id,
                       "expected a luminaire of the result (" + ListNames(ids) + "), got " + Quoted(one.id) +
                           DidYouMean(one.id, ids));
    powers[static_cast<size_t>(found - ids.begin())] = one.power_w;
  }
  return powers;
}

std::string SessionFolder(const std::string& file) {
  return std::filesystem::path(file).parent_path().string();
}

}  // namespace

json ReportData(const FittedRoom& fitted, const ReportOptions& options) {
  const ReportTargets targets = AskedTargets(fitted, options);
  const ReportDetails details = CompletedBy(targets.details, ReportDetailsOfSession(fitted.session.path));
  const std::vector<std::string> folders = {SessionFolder(fitted.session.path), fitted.out};
  const std::string state = options.state.empty() ? BrightestState(fitted) : options.state;
  DimmingOf(fitted, state);  // throws, naming the known states, where it is none
  json data = {{"format", "luxfit-report-1"},    {"luxfit_version", kVersion},        {"date", NowUtc()},
               {"session", fitted.session.name}, {"is_absolute", fitted.is_absolute}, {"state", state}};
  data["details"] = DetailsJson(details);
  data["result"] = JsonWithoutFolders(*fitted.result, folders);
  data["states"] = StatesJson(fitted);
  const FitUncertainty fit = ReadFitUncertainty(fitted.out);
  data["luminaires"] = JsonWithoutFolders(ReportLuminairesJson(fitted, fit), folders);
  data["room"] = ReportRoomJson(fitted);
  data["cameras"] = ReportCamerasJson(fitted);
  data["tags"] = ReportTagsJson(fitted);
  data["places"] = ReportPlacesJson(fitted, fit, targets);
  data["views"] = ReportViewsJson(fitted);
  data["conditions"] = JsonWithoutFolders(ConditionsJson(fitted), folders);
  data["tasks"] = TasksJson();
  data["maintenance_factor"] = targets.maintenance_factor ? json(*targets.maintenance_factor) : json();
  data["power_w"] = PowersJson(fitted, targets);
  data["targets"] = {{"path", WithoutFolders(targets.path, folders)}, {"toml", TargetsToml(targets)}};
  data["command"] = WithoutFolders(options.command_line, folders);
  return data;
}

json ReportSummary(const json& data) {
  json summary = {
      {"session", data.at("session")}, {"state", data.at("state")}, {"is_absolute", data.at("is_absolute")},
      {"states", json::array()},       {"areas", json::array()},    {"observers", json::array()}};
  for (const json& state : data.at("states")) summary["states"].push_back(state.at("id"));
  for (const json& plane : data.at("places").at("planes"))
    summary["areas"].push_back({{"id", plane.at("id")}, {"statistics", plane.at("statistics")}});
  for (const json& observer : data.at("places").at("observers"))
    summary["observers"].push_back({{"id", observer.at("id")}, {"ugr", observer.at("rating")}});
  summary["surfaces"] = json::array();
  for (const json& surface : data.at("places").at("surfaces"))
    summary["surfaces"].push_back({{"id", surface.at("id")},
                                   {"kind", surface.at("kind")},
                                   {"required_lx", surface.at("required_lx")},
                                   {"statistics", surface.at("statistics")}});
  summary["maintenance_factor"] = data.at("maintenance_factor");
  return summary;
}

std::string WriteReport(const FittedRoom& fitted, const json& data) {
  std::string path = fitted.out + "/report.html";
  WriteText(path, ReportPage(fitted.session.name, data));
  return path;
}

}  // namespace luxfit
