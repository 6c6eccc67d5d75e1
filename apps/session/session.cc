#include "apps/session/session.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "apps/session/internal/session_calibration.h"
#include "apps/session/internal/session_camera.h"
#include "apps/session/internal/session_groups.h"
#include "apps/session/internal/session_lights.h"
#include "apps/session/internal/session_luxmeter.h"
#include "apps/session/internal/session_photos.h"
#include "apps/session/internal/session_states.h"
#include "apps/session/photo_colours.h"
#include "apps/session/report_details.h"
#include "apps/session/session_files.h"
#include "apps/session/session_luminaires.h"
#include "apps/session/session_scene.h"
#include "apps/text/formats/toml_reader.h"
#include "apps/text/suggest.h"
#include "forward/mesh/mesh_files.h"

namespace luxfit {
namespace fs = std::filesystem;
namespace {

void ExpectSessionFile(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const fs::path inside = fs::path(path) / "session.toml";
    const bool has_session = fs::is_regular_file(inside, error);
    throw InputError({path}, "session",
                     "expected a session file (TOML), got a folder; " +
                         (has_session ? "did you mean " + Quoted(inside.string()) + "?"
                                      : std::string("name the session file in it")));
  }
  FindFile({path}, "session", "", path);
}

std::string ReadName(const TomlCursor& root, const std::string& path) {
  if (const auto name = root.Find("name")) return name->Text("a name");
  return fs::path(AbsolutePath(path)).parent_path().filename().string();
}

// Checks that a camera without intrinsics can be calibrated: from images of a board, or from the room's
// surveyed tags, which the session's own photos show.
void ExpectCalibrationTargets(const TomlCursor& root, const TomlCursor& cameras, const Session& session) {
  for (const TomlCursor& table : cameras.Elements("a list of tables [[camera]]")) {
    if (table.Find("intrinsics")) continue;
    const bool has_images = table.Find("calibration_images") || table.Find("calibration_corners");
    if (table.Find("calibration_corners") || (has_images && session.tags.survey.empty()))
      table.Require("board", "what the calibration images show (a board, or surveyed tags in [tags] map)");
    if (!has_images && (session.tags.survey.empty() || !root.Find("photos")))
      table.Require("intrinsics", ExpectedIntrinsics());
  }
}

// Reads the tables, which need the states. A session without [states] has the one state that its tables name.
Session WithTables(const TomlCursor& root, const std::string& folder, Session session) {
  const auto photos = root.Find("photos");
  const auto luxmeter = root.Find("luxmeter");
  std::vector<CsvTable> tables;
  if (photos) tables.push_back(ReadPhotoTable(*photos, folder));
  if (luxmeter) tables.push_back(ReadReadingTable(*luxmeter, folder));
  const auto lights = root.Find("lights");
  if (lights) {
    session.states = StatesOfLights(tables.front());
  } else if (const auto states = root.Find("states")) {
    session.states = ReadStates(*states, session.groups);
    session.states_are_named = true;
  } else {
    session.states = {OnlyState(tables, session.luminaires)};
  }
  if (photos) {
    session.photos = PhotosOf(tables.front(), folder, session.cameras, session.states);
    session.photos_path = AbsolutePath(tables.front().path);
  }
  if (lights) session.lights = ReadLightsSection(*lights, folder, session.photos);
  if (luxmeter) session.luxmeter = LuxmeterOf(*luxmeter, folder, tables.back(), session.states);
  return session;
}

// Checks that [registration] start names existing views.
void CheckStartViews(const TomlCursor& registration, const std::vector<SessionPhoto>& photos) {
  const auto start = registration.Find("start");
  if (!start) return;
  std::vector<std::string> views;
  for (const SessionPhoto& photo : photos) {
    if (std::find(views.begin(), views.end(), photo.view) == views.end()) views.push_back(photo.view);
  }
  for (const auto& [view, position] : start->Members()) {
    if (std::find(views.begin(), views.end(), view) == views.end())
      throw position.Error("expected a view of the photo table, got " + Quoted(view) +
                           DidYouMean(view, views));
  }
}

// Checks a session with [lights]. It is that of an object: it has no room, and its lights are not luminaires
// of a room.
void ExpectObjectSession(const TomlCursor& root) {
  const auto lights = root.Find("lights");
  if (!lights) return;
  root.Require("photos", "the photos of the object, one a light");
  for (const char* key :
       {"scene", "tags", "registration", "groups", "states", "luminaires", "luminaire", "luxmeter"}) {
    const auto other = root.Find(key);
    if (other)
      throw other->Error(
          "expected no such section beside [lights], which makes the session one of an object; "
          "remove either");
  }
}

// Returns the files of a model that exist.
std::vector<std::string> ColmapModelFiles(const std::string& folder) {
  std::vector<std::string> files;
  if (folder.empty()) return files;
  for (const char* name : {"cameras", "images", "points3D"}) {
    for (const char* ending : {".bin", ".txt"}) {
      const fs::path path = fs::path(folder) / (std::string(name) + ending);
      std::error_code error;
      if (fs::is_regular_file(path, error)) files.push_back(path.string());
    }
  }
  return files;
}

// Returns every file of the session once, in the order of the format.
std::vector<std::string> InputFiles(const Session& session) {
  std::vector<std::string> files{session.path};
  const auto add = [&](const std::string& file) {
    if (!file.empty() && std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  };
  if (session.scene && !session.scene->mesh.empty()) {
    for (const std::string& file : FilesOfMesh(session.scene->mesh)) add(file);
  }
  add(session.tags.map_path);
  for (const std::string& file : ColmapModelFiles(session.registration.colmap_model)) add(file);
  for (const SessionCamera& camera : session.cameras) {
    add(camera.intrinsics);
    add(camera.response_path);
    add(camera.vignetting_path);
    add(camera.calibration_corners);
    for (const std::string& image : camera.calibration_images) add(image);
  }
  add(session.photos_path);
  for (const SessionPhoto& photo : session.photos) add(photo.file);
  add(session.luxmeter.readings_path);
  add(session.luxmeter.sensitivity_path);
  for (const SessionLuminaire& luminaire : session.luminaires) add(luminaire.photometry_path);
  if (session.lights) {
    add(session.lights->mask);
    add(session.lights->directions_path);
    add(session.lights->mirror_mask);
    add(session.lights->reference_mask);
  }
  return files;
}

}  // namespace

std::string ToString(ReadingRole role) {
  return role == ReadingRole::kFit ? "fit" : (role == ReadingRole::kScale ? "scale" : "check");
}

Session ReadSession(const std::string& path) {
  ExpectSessionFile(path);
  const toml::table document = ReadTomlFile(path);
  const TomlCursor root(document, {path, 1}, "");
  root.ExpectKeys({"name", "scene", "tags", "registration", "camera", "calibration", "photos", "groups",
                   "states", "luminaires", "luminaire", "luxmeter", "lights", "report"});
  if (const auto report = root.Find("report"))
    ReadReportDetails(*report);  // only checked: the report reads it
  ExpectObjectSession(root);
  const std::string folder = fs::path(path).parent_path().string();
  Session session;
  session.name = ReadName(root, path);
  session.path = AbsolutePath(path);
  if (const auto scene = root.Find("scene")) session.scene = ReadSceneSection(*scene, folder);
  if (const auto tags = root.Find("tags")) session.tags = ReadTagsSection(*tags, folder);
  if (const auto registration = root.Find("registration"))
    session.registration = ReadRegistrationSection(*registration, folder);
  if (const auto cameras = root.Find("camera")) {
    session.cameras = ReadCameras(*cameras, folder);
    // Photos of an object are taken as orthographic, so no lens is needed.
    if (!root.Find("lights")) ExpectCalibrationTargets(root, *cameras, session);
  }
  if (const auto calibration = root.Find("calibration"))
    session.calibration = ReadCalibrationSection(*calibration);
  const NamedLuminaires named = ReadLuminaires(root, folder);
  session.groups = named.groups;
  session.luminaires = named.luminaires;
  session.count_is_estimated = named.count_is_estimated && !root.Find("lights");
  session.max_luminaires = named.max;
  session = WithColoursOfPhotos(WithTables(root, folder, std::move(session)));
  if (!session.count_is_estimated) session = WithMoreLuminaires(std::move(session), named.count);
  ExpectGroupsAlone(root, session);
  if (const auto registration = root.Find("registration")) CheckStartViews(*registration, session.photos);
  session.input_files = InputFiles(session);
  return session;
}

Session WithMoreLuminaires(Session session, int count) {
  for (int next = 1; static_cast<int>(session.luminaires.size()) < count; ++next) {
    SessionLuminaire luminaire;
    luminaire.id = "lamp" + std::to_string(next);
    const bool is_taken = std::any_of(session.luminaires.begin(), session.luminaires.end(),
                                      [&](const SessionLuminaire& one) { return one.id == luminaire.id; });
    if (is_taken) continue;
    for (SessionState& state : session.states) state.dimming[luminaire.id] = 1;
    session.luminaires.push_back(luminaire);
  }
  return session;
}

std::vector<std::string> OpenGroups(const Session& session) {
  std::vector<std::string> names;
  for (const SessionGroup& group : session.groups) {
    if (group.count_is_estimated) names.push_back(group.name);
  }
  return names;
}

Session WithCountedGroup(Session session, const std::string& group, int count) {
  std::vector<std::string> ids;
  for (int i = 1; i <= count; ++i) ids.push_back(group + "_" + std::to_string(i));
  for (SessionGroup& one : session.groups) {
    if (one.name == group) one.luminaires = ids;
  }
  const auto stands = std::find_if(session.luminaires.begin(), session.luminaires.end(),
                                   [&](const SessionLuminaire& luminaire) { return luminaire.id == group; });
  std::vector<SessionLuminaire> counted(ids.size(), *stands);
  for (size_t i = 0; i < ids.size(); ++i) counted[i].id = ids[i];
  session.luminaires.insert(session.luminaires.erase(stands), counted.begin(), counted.end());
  for (SessionState& state : session.states) {
    const auto on = state.dimming.find(group);
    if (on == state.dimming.end()) continue;
    for (const std::string& id : ids) state.dimming[id] = on->second;
    state.dimming.erase(on);
  }
  return session;
}

int StateOfGroupAlone(const Session& session, const std::string& group) {
  int brightest = -1;
  double most = 0;
  for (size_t s = 0; s < session.states.size(); ++s) {
    double own = 0;
    bool is_alone = true;
    for (const auto& [id, dimming] : session.states[s].dimming) {
      if (id == group) own = dimming;
      is_alone = is_alone && (id == group || dimming == 0);
    }
    if (!is_alone || own <= most) continue;
    brightest = static_cast<int>(s);
    most = own;
  }
  return brightest;
}

int StateIndex(const Session& session, const std::string& id) {
  const auto found = std::find_if(session.states.begin(), session.states.end(),
                                  [&](const SessionState& state) { return state.id == id; });
  return found == session.states.end() ? -1 : static_cast<int>(found - session.states.begin());
}

Eigen::Vector3d LuminanceWeights(const Session& session) {
  return session.cameras.empty() ? SessionCamera().luminance_weights : session.cameras[0].luminance_weights;
}

}  // namespace luxfit
