#include "apps/session/internal/session_lights.h"

#include <algorithm>

#include "apps/session/session_files.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

void AddOnce(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

std::vector<std::string> ViewsOf(const std::vector<SessionPhoto>& photos) {
  std::vector<std::string> views;
  for (const SessionPhoto& photo : photos) AddOnce(views, photo.view);
  return views;
}

std::vector<std::string> StatesOf(const std::vector<SessionPhoto>& photos, const std::string& view) {
  std::vector<std::string> states;
  for (const SessionPhoto& photo : photos) {
    if (photo.view == view) AddOnce(states, photo.state);
  }
  return states;
}

std::string ReadView(const TomlCursor& value, const std::vector<std::string>& views) {
  std::string view = value.Text("a view of the photo table");
  if (std::find(views.begin(), views.end(), view) == views.end())
    throw value.Error("expected a view of the photo table (" + ListNames(views) + "), got " + Quoted(view) +
                      DidYouMean(view, views));
  return view;
}

std::string ReadMask(const TomlCursor& table, const std::string& folder, const std::string& of_what) {
  return AbsolutePath(
      FindFile(table.Require("mask", "a picture that is bright where " + of_what + " is"), folder));
}

void ReadMirrorSphere(const TomlCursor& table, const std::string& folder,
                      const std::vector<std::string>& views, SessionLights& lights) {
  table.ExpectKeys({"view", "mask"});
  if (const auto view = table.Find("view")) lights.mirror_view = ReadView(*view, views);
  lights.mirror_mask = ReadMask(table, folder, "the mirror sphere");
}

void ReadReference(const TomlCursor& table, const std::string& folder, SessionLights& lights) {
  table.ExpectKeys({"mask", "albedo"});
  lights.reference_mask = ReadMask(table, folder, "the surface of known albedo");
  const TomlCursor albedo = table.Require("albedo", "its reflectance, 0..1");
  lights.reference_albedo = albedo.NumberAbove(0, "(a reflectance; 18 % is written 0.18)");
  if (lights.reference_albedo > 1)
    throw albedo.Error("expected a reflectance in 0..1, got " + albedo.Shown() + "; 18 % is written 0.18");
}

// Returns the only view other than the mirror sphere's.
std::string ObjectView(const TomlCursor& section, std::vector<std::string> views,
                       const SessionLights& lights) {
  if (const auto view = section.Find("view")) return ReadView(*view, views);
  if (views.size() > 1) views.erase(std::remove(views.begin(), views.end(), lights.mirror_view), views.end());
  if (views.size() == 1) return views.front();
  throw section.Error("expected view, the one that shows the object, among " + ListNames(views) +
                      ", got none; add view = " + Quoted(views.front()));
}

void ReadDirections(const TomlCursor& value, const std::string& folder, SessionLights& lights) {
  const std::string path = FindFile(value, folder);
  const CsvTable table = ReadCsvTable(path, {{"state", "x", "y", "z"}, {"strength"}});
  lights.directions_path = AbsolutePath(path);
  for (const CsvRow& row : table.rows) {
    SessionLights::Light light;
    light.to_light = {CsvNumber(table, row, "x"), CsvNumber(table, row, "y"), CsvNumber(table, row, "z")};
    if (light.to_light.isZero())
      throw CsvError(table, row, "x", "expected a direction towards the light, got 0, 0, 0; correct the row");
    light.to_light.normalize();
    if (HasColumn(table, "strength")) {
      light.strength = CsvNumber(table, row, "strength");
      if (!(light.strength > 0))
        throw CsvError(table, row, "strength",
                       "expected > 0, got " + Quoted(CsvText(table, row, "strength")) + "; correct the row");
    }
    const std::string& state = CsvText(table, row, "state");
    if (!lights.light_of_state.emplace(state, light).second)
      throw CsvError(table, row, "state",
                     "expected every state once, got " + Quoted(state) + " again; remove the row");
  }
}

// Checks that every state of the object's photos has a direction, or a photo of the mirror sphere.
void ExpectLights(const TomlCursor& section, const std::vector<SessionPhoto>& photos,
                  const SessionLights& lights) {
  const std::vector<std::string> states = StatesOf(photos, lights.view);
  std::vector<std::string> known;
  for (const auto& [state, light] : lights.light_of_state) known.push_back(state);
  if (lights.directions_path.empty()) known = StatesOf(photos, lights.mirror_view);
  const std::string where = lights.directions_path.empty() ? "photos of view " + Quoted(lights.mirror_view)
                                                           : lights.directions_path;
  for (const std::string& state : states) {
    if (state == lights.ambient_state || std::find(known.begin(), known.end(), state) != known.end())
      continue;
    throw section.Error("expected a direction for every state of view " + Quoted(lights.view) +
                        ", got none for " + Quoted(state) + " in " + where + DidYouMean(state, known));
  }
}

}  // namespace

std::vector<SessionState> StatesOfLights(const CsvTable& photos) {
  std::vector<std::string> names;
  for (const CsvRow& row : photos.rows) {
    const std::string& name = CsvText(photos, row, "state");
    if (name.empty())
      throw CsvError(photos, row, "state", "expected a name, got nothing; name the light that is on");
    AddOnce(names, name);
  }
  std::vector<SessionState> states;
  states.reserve(names.size());
  for (const std::string& name : names) states.push_back({name, {}});
  return states;
}

SessionLights ReadLightsSection(const TomlCursor& section, const std::string& folder,
                                const std::vector<SessionPhoto>& photos) {
  section.ExpectKeys({"view", "mask", "directions", "direction_sigma_deg", "mirror_sphere", "strengths",
                      "ambient", "reference"});
  SessionLights lights;
  lights.line = section.place().line;
  lights.mask = ReadMask(section, folder, "the object");
  const std::vector<std::string> views = ViewsOf(photos);
  const auto directions = section.Find("directions"), mirror = section.Find("mirror_sphere");
  if (directions && mirror)
    throw mirror->Error("expected directions or a mirror sphere, got both; remove one");
  if (!directions && !mirror)
    section.Require("directions", "the table of directions (state,x,y,z), or mirror_sphere = { mask = ... }");
  if (directions) ReadDirections(*directions, folder, lights);
  if (mirror) ReadMirrorSphere(*mirror, folder, views, lights);
  lights.view = ObjectView(section, views, lights);
  if (mirror && lights.mirror_view.empty()) lights.mirror_view = lights.view;
  if (const auto sigma = section.Find("direction_sigma_deg")) {
    if (mirror)
      throw sigma->Error(
          "expected it beside directions only, got a mirror sphere, which has its own; remove it");
    lights.direction_sigma_deg = sigma->NumberAtLeast(0, "degrees");
  }
  if (const auto strengths = section.Find("strengths"))
    lights.strengths_known = strengths->OneOf({"known", "estimate"}) == "known";
  if (const auto ambient = section.Find("ambient")) {
    const std::vector<std::string> states = StatesOf(photos, lights.view);
    lights.ambient_state = ambient->Text("the state with all lights off");
    if (std::find(states.begin(), states.end(), lights.ambient_state) == states.end())
      throw ambient->Error("expected a state of view " + Quoted(lights.view) + " (" + ListNames(states) +
                           "), got " + ambient->Shown() + DidYouMean(lights.ambient_state, states));
  }
  if (const auto reference = section.Find("reference")) ReadReference(*reference, folder, lights);
  ExpectLights(section, photos, lights);
  return lights;
}

}  // namespace luxfit
