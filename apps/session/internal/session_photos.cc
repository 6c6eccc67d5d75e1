#include "apps/session/internal/session_photos.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "apps/session/internal/session_states.h"
#include "apps/session/session_files.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

int CameraIndex(const CsvTable& table, const CsvRow& row, const std::vector<SessionCamera>& cameras) {
  const std::string& id = CsvText(table, row, "camera");
  std::vector<std::string> known;
  known.reserve(cameras.size());
  for (const SessionCamera& camera : cameras) known.push_back(camera.id);
  const auto at = std::find(known.begin(), known.end(), id);
  if (at != known.end()) return static_cast<int>(at - known.begin());
  if (known.empty())
    throw CsvError(table, row, "camera",
                   "expected a camera of the session, got " + Quoted(id) +
                       ", and the session has none; add [[camera]] with id = " + Quoted(id));
  const std::string nearest = DidYouMean(id, known);
  throw CsvError(table, row, "camera",
                 "expected a known camera (" + ListNames(known) + "), got " + Quoted(id) +
                     (nearest.empty() ? "; add [[camera]] with this id, or correct the row" : nearest));
}

// Returns the field of a column that may be missing or empty.
std::optional<double> PositiveOrNone(const CsvTable& table, const CsvRow& row, const std::string& column,
                                     const std::string& remedy) {
  if (!HasColumn(table, column) || CsvText(table, row, column).empty()) return std::nullopt;
  const double value = CsvNumber(table, row, column);
  if (value <= 0)
    throw CsvError(
        table, row, column,
        "expected > 0, got " + Quoted(CsvText(table, row, column)) + "; " + remedy + ", or leave it empty");
  return value;
}

SessionPhoto ReadRow(const CsvTable& table, const CsvRow& row, const std::string& folder,
                     const std::vector<SessionCamera>& cameras, const std::vector<SessionState>& states) {
  SessionPhoto photo;
  photo.line = row.line;
  photo.file = AbsolutePath(FindFile({table.path, row.line}, "file", folder, CsvText(table, row, "file")));
  photo.camera = CameraIndex(table, row, cameras);
  photo.view = CsvText(table, row, "view");
  if (photo.view.empty())
    throw CsvError(table, row, "view", "expected a name, got nothing; photos from one place share one name");
  photo.state = StateOfRow(table, row, states);
  // An empty field leaves the value to the file's own metadata.
  photo.exposure_s =
      PositiveOrNone(table, row, "exposure_s", "write the exposure time in seconds").value_or(0);
  photo.f_number = PositiveOrNone(table, row, "aperture", "write the f-number");
  photo.iso = PositiveOrNone(table, row, "iso", "write the ISO speed");
  return photo;
}

void ExpectNoRepeats(const CsvTable& table, const std::vector<SessionPhoto>& photos) {
  std::map<std::string, int> line_of_file;
  std::map<std::tuple<int, std::string, std::string, double, double, double>, int> line_of_exposure;
  std::map<std::string, const SessionPhoto*> first_of_view;
  for (size_t i = 0; i < photos.size(); ++i) {
    const SessionPhoto& photo = photos[i];
    const CsvRow& row = table.rows[i];
    const auto file = line_of_file.emplace(photo.file, photo.line);
    if (!file.second)
      throw CsvError(table, row, "file",
                     "expected every photo once, got " + Quoted(CsvText(table, row, "file")) +
                         ", which line " + std::to_string(file.first->second) +
                         " has already; correct or remove the row");
    const auto exposure =
        line_of_exposure.emplace(std::tuple(photo.camera, photo.view, photo.state, photo.exposure_s,
                                            photo.f_number.value_or(0), photo.iso.value_or(0)),
                                 photo.line);
    if (!exposure.second && photo.exposure_s > 0)
      throw CsvError(table, row, "exposure_s",
                     "expected photos of one view, state and camera to differ in exposure, got " +
                         CsvText(table, row, "exposure_s") + " s in line " +
                         std::to_string(exposure.first->second) + " too; correct or remove the row");
    const SessionPhoto* first = first_of_view.emplace(photo.view, &photo).first->second;
    if (first->camera != photo.camera)
      throw CsvError(table, row, "view",
                     "expected one camera per view, for a view is one pose; got another one for " +
                         Quoted(photo.view) + " in line " + std::to_string(first->line) +
                         "; give the view of each camera a name of its own");
  }
}

}  // namespace

CsvTable ReadPhotoTable(const TomlCursor& section, const std::string& folder) {
  section.ExpectKeys({"table"});
  const std::string path = FindFile(section.Require("table", "the table of photos (CSV)"), folder);
  return ReadCsvTable(path, {{"file", "camera", "view", "state", "exposure_s"}, {"aperture", "iso", "note"}});
}

std::vector<SessionPhoto> PhotosOf(const CsvTable& table, const std::string& folder,
                                   const std::vector<SessionCamera>& cameras,
                                   const std::vector<SessionState>& states) {
  std::vector<SessionPhoto> photos;
  for (const CsvRow& row : table.rows) photos.push_back(ReadRow(table, row, folder, cameras, states));
  ExpectNoRepeats(table, photos);
  return photos;
}

}  // namespace luxfit
