#include "apps/commands/internal/new_photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "apps/session/session_files.h"
#include "apps/stages/register/view_tags.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"
#include "calib/luminance/exposure.h"
#include "inverse/observe/scene_surface.h"

namespace luxfit {
namespace {

// Gives each new photo or bracket a state of its own, so that no two are taken for exposures of one.
constexpr char kNewState[] = "(new) ";

struct Row {
  std::string file, camera, view, time;
  double exposure_s = 0;
  std::optional<double> f_number, iso;
  SourcePlace place;
};

std::optional<double> Optional(const CsvTable& table, const CsvRow& row, const std::string& column) {
  if (!HasColumn(table, column) || CsvText(table, row, column).empty()) return std::nullopt;
  const double value = CsvNumber(table, row, column);
  if (!(value > 0))
    throw CsvError(table, row, column, "expected > 0, got " + CsvText(table, row, column) + "; correct it");
  return value;
}

std::vector<Row> RowsOfTable(const std::string& path) {
  const CsvTable table =
      ReadCsvTable(path, {{"file", "camera", "view"}, {"exposure_s", "time", "aperture", "iso"}});
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  std::vector<Row> rows;
  for (const CsvRow& row : table.rows) {
    const SourcePlace place{path, row.line};
    Row read{AbsolutePath(FindFile(place, "file", folder, CsvText(table, row, "file"))),
             CsvText(table, row, "camera"),
             CsvText(table, row, "view"),
             HasColumn(table, "time") ? CsvText(table, row, "time") : "",
             Optional(table, row, "exposure_s").value_or(0),
             Optional(table, row, "aperture"),
             Optional(table, row, "iso"),
             place};
    rows.push_back(std::move(read));
  }
  return rows;
}

std::vector<Row> RowsOf(const LuxmapCommandOptions& options) {
  if (options.photos.empty())
    throw std::runtime_error("PHOTO: expected photos or a table of them, got nothing; name at least one");
  if (options.photos.size() == 1 && ExtensionOf(options.photos[0]) == ".csv")
    return RowsOfTable(options.photos[0]);
  std::vector<Row> rows;
  for (const std::string& file : options.photos)
    rows.push_back({AbsolutePath(FindFile({file, 0}, "", "", file)),
                    options.camera,
                    options.view,
                    "",
                    options.exposure_s,
                    std::nullopt,
                    std::nullopt,
                    {file, 0}});
  return rows;
}

// Luminance follows from the exposure, which the photo's file or the user states.
void ExpectExposure(const Row& row) {
  if (row.exposure_s > 0 || ReadExposureMetadata(row.file).exposure_s) return;
  throw InputError(
      row.place, "exposure_s",
      "expected the exposure time of the photo, which its file does not state, got nothing; give "
      "--exposure-s, or the column exposure_s in a table of photos");
}

int CameraOf(const Session& session, const Row& row) {
  std::vector<std::string> ids;
  for (const SessionCamera& camera : session.cameras) ids.push_back(camera.id);
  if (row.camera.empty() && ids.size() == 1) return 0;
  const auto at = std::find(ids.begin(), ids.end(), row.camera);
  if (at == ids.end()) throw InputError(row.place, "camera", ExpectedOneOf(ids, row.camera));
  return static_cast<int>(at - ids.begin());
}

const RegisteredView& ViewOf(const FittedRoom& fitted, const Row& row) {
  std::vector<std::string> names;
  for (const RegisteredView& view : fitted.registered.registration.views) {
    if (view.view == row.view) return view;
    names.push_back(view.view);
  }
  if (row.view.empty())
    throw InputError(row.place, "view",
                     "expected the view from which the photo was taken, got nothing; give --view, one of " +
                         ListNames(names) + ", or --pose tags");
  throw InputError(row.place, "view", ExpectedOneOf(names, row.view));
}

// Reads the response that the run estimated; new photos need not determine it again.
void KeepResponses(const FittedRoom& fitted, Session& session) {
  for (SessionCamera& camera : session.cameras) {
    if (camera.response != "estimate") continue;
    camera.response = "file";
    camera.response_path = fitted.out + "/response_" + camera.id + ".csv";
  }
}

// Returns the session with its first photo of each camera, to which exposures are relative, and with the new
// photos.
Session WithRows(const FittedRoom& fitted, const std::vector<Row>& rows, bool pose_from_tags) {
  Session session = fitted.session;
  session.photos.clear();
  for (size_t c = 0; c < session.cameras.size(); ++c) {
    const auto first =
        std::find_if(fitted.session.photos.begin(), fitted.session.photos.end(),
                     [&](const SessionPhoto& p) { return static_cast<size_t>(p.camera) == c; });
    if (first != fitted.session.photos.end()) session.photos.push_back(*first);
  }
  std::map<std::string, double> all_on;
  for (const Luminaire& luminaire : fitted.luminaires) all_on[luminaire.id] = 1;
  for (size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    SessionPhoto photo;
    photo.file = row.file;
    photo.camera = CameraOf(session, row);
    photo.state = kNewState + (row.time.empty() ? std::to_string(i) : row.time);
    photo.view = row.view;
    if (pose_from_tags && photo.view.empty()) photo.view = photo.state;
    photo.exposure_s = row.exposure_s;
    photo.f_number = row.f_number;
    photo.iso = row.iso;
    photo.line = row.place.line;
    session.photos.push_back(photo);
    const auto known = std::find_if(session.states.begin(), session.states.end(),
                                    [&](const SessionState& s) { return s.id == photo.state; });
    if (known == session.states.end()) session.states.push_back({photo.state, all_on});
  }
  KeepResponses(fitted, session);
  return session;
}

bool IsNew(const LinearizedPhoto& photo) { return photo.state.rfind(kNewState, 0) == 0; }

// Finds poses by the room's tags, which must hang where the run had them.
std::map<std::string, Eigen::Isometry3d> PosesByTags(const FittedRoom& fitted, const Session& session,
                                                     LinearizedPhotos linearized, RunContext& context) {
  std::vector<LinearizedPhoto>& photos = linearized.photos;
  photos.erase(
      std::remove_if(photos.begin(), photos.end(), [](const LinearizedPhoto& p) { return !IsNew(p); }),
      photos.end());
  const std::vector<SurveyedTag>& tags =
      session.tags.survey.empty() ? fitted.registered.registration.placed_tags : session.tags.survey;
  if (tags.empty())
    throw std::runtime_error("--pose tags: expected a session with tags, got one without; give --view");
  const std::vector<Camera>& cameras = fitted.registered.cameras;
  RegisterViewsOptions surveyed;
  surveyed.surface = SurfaceOf(fitted.room.scene);
  const Registration registration = RegisterViews(
      cameras, tags, DetectViews(session, linearized, cameras, PhotosByView(session, photos), context).views,
      surveyed);
  for (const RegistrationNote& note : registration.notes)
    context.warnings.push_back({note.code, note.message, note.remedy});
  std::map<std::string, Eigen::Isometry3d> poses;
  for (const RegisteredView& view : registration.views) poses[view.view] = view.cam_from_world;
  return poses;
}

}  // namespace

NewPhotos ReadNewPhotos(const FittedRoom& fitted, const LuxmapCommandOptions& options, RunContext& context) {
  const std::vector<Row> rows = RowsOf(options);
  for (const Row& row : rows) ExpectExposure(row);
  std::map<std::string, Eigen::Isometry3d> poses;
  for (const Row& row : rows) {
    if (!options.pose_from_tags) poses[row.view] = ViewOf(fitted, row).cam_from_world;
  }
  std::map<std::string, std::string> time_of;
  for (const Row& row : rows) time_of[row.file] = row.time;
  const Session session = WithRows(fitted, rows, options.pose_from_tags);
  NewPhotos read;
  read.linearized = LinearizeSession(session, context).photos;
  if (options.pose_from_tags) poses = PosesByTags(fitted, session, read.linearized, context);
  for (const LinearizedPhoto& photo : read.linearized.photos) {
    if (!IsNew(photo)) continue;
    const auto pose = poses.find(photo.view);
    if (pose == poses.end()) {
      context.AddUndetermined({"no_tags", photo.view + " has no pose: no tag of the room places it",
                               "photograph the tags of the room too, or name the view of the run by --view"});
      continue;
    }
    read.photos.push_back({photo, time_of[photo.file], pose->second});
  }
  return read;
}

}  // namespace luxfit
