#include "apps/commands/internal/examine_session.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "apps/stages/calibrate/board_text.h"
#include "apps/stages/calibrate/calibration_images.h"
#include "apps/stages/calibrate/shown_board.h"
#include "apps/stages/check/session_check.h"
#include "apps/stages/session_light.h"
#include "apps/stages/simulate/given_luminaire.h"
#include "apps/stages/stages.h"
#include "apps/text/file_stem.h"
#include "apps/text/suggest.h"
#include "calib/lens/camera_file.h"
#include "calib/luminance/exposure.h"
#include "calib/photo_files/image.h"
#include "calib/photo_files/tone_mapped.h"
#include "calib/targets/tags.h"

namespace luxfit {
namespace {

constexpr int kNamedFiles = 3;

using DoctorFindings = std::vector<DoctorFinding>;

// Adds what the stages of `luxfit run` say, in their words.
void AddWarnings(const std::vector<Warning>& warnings, DoctorFindings& findings) {
  for (const Warning& warning : warnings)
    findings.push_back(
        {warning.is_of_outcome ? Health::kBad : Health::kNote, warning.message, warning.remedy});
}

// Holds a folder for what the stages write; it goes with this object.
class TrialFolder {
 public:
  TrialFolder() : path_(std::filesystem::temp_directory_path() / fmt::format("luxfit_doctor_{}", getpid())) {
    context_.out = path_.string();
    context_.is_quiet = true;
  }
  ~TrialFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;

  RunContext& context() { return context_; }

 private:
  std::filesystem::path path_;
  RunContext context_;
};

void ExamineRoom(const Session& session, RunContext& context, DoctorFindings& findings) {
  if (!session.scene) {
    findings.push_back(
        {Health::kNote, "no [scene]: all light is taken as direct", "give the room: size, outline or mesh"});
    return;
  }
  try {
    const Room room = LoadRoom(session, context);
    const Eigen::Vector3d size = room.scene.Bounds().sizes();
    findings.push_back(
        {Health::kGood,
         fmt::format("{} of {:.2f} x {:.2f} x {:.2f} m, {} facets{}, {} materials",
                     session.scene->outline ? "outline" : "mesh", size.x(), size.y(), size.z(),
                     room.on_planes ? room.on_planes->triangles : static_cast<int>(room.scene.facets.size()),
                     room.on_planes ? fmt::format(" on {} planes", room.scene.facets.size()) : "",
                     room.scene.materials.size()),
         ""});
    AddWarnings(context.warnings, findings);
    AddWarnings(CheckSession(OnSurfaceOf(room, session), room.rays).warnings, findings);
  } catch (const std::runtime_error& e) {
    findings.push_back({Health::kBad, e.what(), ""});
  }
}

void ExaminePhotometry(const Session& session, DoctorFindings& findings) {
  Findings said;
  for (const SessionLuminaire& luminaire : session.luminaires) {
    if (luminaire.photometry_path.empty()) continue;
    try {
      const GivenLuminaire known = ReadGivenLuminaire(luminaire);
      RecordPhotometryFile(luminaire.id, *known.file, said);
      if (!luminaire.flux_lm) WarnOfTilt(known.luminaire, *known.file, said);
    } catch (const std::runtime_error& e) {
      findings.push_back({Health::kBad, e.what(), ""});
    }
  }
  AddWarnings(said.warnings, findings);
}

// Linearizes, calibrates and registers as `run` does, but for COLMAP, which takes minutes.
void ExamineRegistration(const Session& session, RunContext& context, DoctorFindings& findings) {
  Session by_tags = session;
  by_tags.registration.method = "tags";
  const size_t said = context.warnings.size();
  try {
    const LinearizedPhotos photos = LinearizePhotos(by_tags, context);
    const RegisteredSession registered = RegisterSession(by_tags, photos, context);
    findings.push_back(
        {Health::kGood,
         fmt::format("{} views are placed by tags, reprojection RMS {:.3f} px",
                     registered.registration.views.size(), registered.registration.reprojection_rms_px),
         ""});
  } catch (const std::runtime_error& e) {
    findings.push_back({Health::kBad, e.what(), ""});
  }
  AddWarnings({context.warnings.begin() + static_cast<std::ptrdiff_t>(said), context.warnings.end()},
              findings);
}

struct LookedAt {
  std::string problem, remedy;
  std::vector<int> tags;
};

LookedAt LookAt(const Session& session, const SessionPhoto& photo, const std::optional<Camera>& camera,
                bool for_tags) {
  LookedAt look;
  try {
    const Photo counts = ReadPhoto(photo.file);
    const std::string mapped = SignOfToneMapping(photo.file);
    const SessionCamera& settings = session.cameras[static_cast<size_t>(photo.camera)];
    if (!mapped.empty()) {
      look.problem = ToneMappingInWords(mapped);
      look.remedy = kToneMappingRemedy;
    } else if (counts.bits_per_channel == 8 && settings.response == "linear") {
      look.problem = "has 8 bits, camera " + Quoted(settings.id) + " is declared linear";
      look.remedy =
          "give 16-bit or RAW photos, or response = \"estimate\" with brackets of two exposures or more, or "
          "\"srgb\"";
    } else if (camera && (counts.width_px() != camera->width_px || counts.height_px() != camera->height_px)) {
      look.problem = fmt::format("is {} x {}, the intrinsics are of {} x {}", counts.width_px(),
                                 counts.height_px(), camera->width_px, camera->height_px);
      look.remedy = "give the intrinsics of this resolution";
    } else if (!(photo.exposure_s > 0) && !ReadExposureMetadata(photo.file).exposure_s) {
      look.problem = "has no exposure, in the table or of its own";
      look.remedy = "fill in exposure_s";
    }
    if (!for_tags) return look;
    DetectTagsOptions options;
    options.family = session.tags.family;
    for (const TagDetection& tag : DetectTags(counts.rgb_counts[1], options)) look.tags.push_back(tag.id);
  } catch (const std::runtime_error& e) {
    look.problem = e.what();
  }
  return look;
}

void ExamineTags(const Session& session, const std::map<std::string, std::vector<int>>& tags_of_view,
                 DoctorFindings& findings) {
  std::vector<std::string> without;
  std::set<int> unknown;
  for (const auto& [view, tags] : tags_of_view) {
    bool has_surveyed = false;
    for (const int id : tags) {
      const bool is_surveyed = std::any_of(session.tags.survey.begin(), session.tags.survey.end(),
                                           [&](const SurveyedTag& tag) { return tag.id == id; });
      has_surveyed = has_surveyed || is_surveyed || session.tags.survey.empty();
      if (!is_surveyed && !session.tags.survey.empty()) unknown.insert(id);
    }
    if (!has_surveyed) without.push_back(view);
  }
  if (without.size() < tags_of_view.size())
    findings.push_back(
        {Health::kGood,
         fmt::format("{} of {} views show tags", tags_of_view.size() - without.size(), tags_of_view.size()),
         ""});
  if (!without.empty())
    findings.push_back(
        {without.size() == tags_of_view.size() ? Health::kBad : Health::kNote,
         "no surveyed tag is seen in " + ListNames(without),
         "hang one there, 40 pixels a side and more, or let COLMAP place these views by features"});
  if (!unknown.empty())
    findings.push_back({Health::kNote,
                        fmt::format("tags {} are seen and not in the map", fmt::join(unknown, " ")),
                        "survey them too"});
}

// Its photos of the room show surveyed tags, and nothing else says what its lens is. That takes seconds.
bool IsCalibratedFromOwnPhotos(const Session& session, const SessionCamera& camera) {
  return camera.intrinsics.empty() && camera.calibration_images.empty() &&
         camera.calibration_corners.empty() && CanBeCalibrated(session, camera);
}

void ExaminePhotos(const Session& session, RunContext& context, DoctorFindings& findings) {
  if (session.photos.empty()) {
    findings.push_back({Health::kNote, "no [photos]: the fit is to readings alone", ""});
    return;
  }
  std::vector<std::optional<Camera>> cameras;
  for (const SessionCamera& camera : session.cameras)
    cameras.push_back(camera.intrinsics.empty() ? std::nullopt
                                                : std::optional(ReadCamera(camera.intrinsics, camera.id)));
  std::set<std::string> views;
  std::vector<bool> for_tags;
  for (const SessionPhoto& photo : session.photos) for_tags.push_back(views.insert(photo.view).second);
  std::vector<LookedAt> looks(session.photos.size());
  tbb::parallel_for(size_t{0}, session.photos.size(), [&](size_t i) {
    const SessionPhoto& photo = session.photos[i];
    looks[i] = LookAt(session, photo, cameras[static_cast<size_t>(photo.camera)], for_tags[i]);
  });
  std::map<std::string, std::vector<int>> tags_of_view;
  size_t problems = 0;
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> files_of_problem;
  for (size_t i = 0; i < looks.size(); ++i) {
    if (for_tags[i]) tags_of_view[session.photos[i].view] = looks[i].tags;
    if (looks[i].problem.empty()) continue;
    ++problems;
    files_of_problem[{looks[i].problem, looks[i].remedy}].push_back(FileName(session.photos[i].file));
  }
  for (const auto& [problem, files] : files_of_problem)
    findings.push_back({Health::kBad, ListNames(files, kNamedFiles) + ": " + problem.first, problem.second});
  findings.push_back({problems == 0 ? Health::kGood : Health::kNote,
                      fmt::format("{} of {} photos can be used, {} views", looks.size() - problems,
                                  looks.size(), views.size()),
                      ""});
  const bool has_intrinsics = std::all_of(
      session.cameras.begin(), session.cameras.end(),
      [&](const SessionCamera& c) { return !c.intrinsics.empty() || IsCalibratedFromOwnPhotos(session, c); });
  const bool has_tags = std::any_of(tags_of_view.begin(), tags_of_view.end(),
                                    [](const auto& view) { return !view.second.empty(); });
  if (has_intrinsics && has_tags && problems == 0 && !session.lights) {
    ExamineRegistration(session, context, findings);
  } else {
    ExamineTags(session, tags_of_view, findings);
  }
}

// Says how many of a camera's calibration images show the target. `is_of_another`: another board was found in them, which is
// said beside it.
DoctorFinding ImagesThatShow(const CalibrationGroup& group, std::size_t camera, bool is_of_another) {
  const CalibrationInput& input = group.input;
  std::size_t images = 0, showing = 0;
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    if (input.images[i].camera != static_cast<int>(camera)) continue;
    ++images;
    if (!input.images[i].corners.empty() && group.messages.count(static_cast<int>(i)) == 0) ++showing;
  }
  const std::string what =
      fmt::format("{}: {} of {} calibration images show {}", input.cameras[camera].id, showing, images,
                  group.board ? "the board, " + BoardArgument(*group.board) : "surveyed tags");
  if (showing == images) return {Health::kGood, what, ""};
  if (is_of_another) return {Health::kNote, what, ""};
  if (showing == 0) return {Health::kBad, what, "compare them with what was photographed"};
  return {Health::kNote, what, "leave the others out, or photograph again"};
}

// Names another board that the images show in the words of `luxfit calibrate`.
void ExamineCalibrationGroup(const Session& session, const CalibrationGroup& group,
                             DoctorFindings& findings) {
  std::string another;
  try {
    ExpectBoardShown(session, group);
  } catch (const std::runtime_error& e) {
    another = e.what();
  }
  for (std::size_t c = 0; c < group.input.cameras.size(); ++c)
    findings.push_back(ImagesThatShow(group, c, !another.empty()));
  if (!another.empty()) findings.push_back({Health::kBad, another, ""});
}

void ExamineCalibration(const Session& session, DoctorFindings& findings) {
  std::vector<int> cameras;
  for (std::size_t c = 0; c < session.cameras.size(); ++c) {
    const SessionCamera& camera = session.cameras[c];
    const bool has_own = !camera.calibration_images.empty() || !camera.calibration_corners.empty();
    if (has_own && CanBeCalibrated(session, camera)) cameras.push_back(static_cast<int>(c));
  }
  try {
    for (const CalibrationGroup& group : ReadCalibrationImages(session, {}, cameras))
      ExamineCalibrationGroup(session, group, findings);
  } catch (const std::runtime_error& e) {
    findings.push_back({Health::kBad, e.what(), ""});
  }
}

// Checks that the states tell luminaires apart, which takes as many independent states as there are
// luminaires.
void ExamineStates(const Session& session, DoctorFindings& findings) {
  if (session.luminaires.empty()) return;
  const std::vector<Eigen::VectorXd> by_state = DimmingOf(session);
  Eigen::MatrixXd dimming(static_cast<Eigen::Index>(by_state.size()),
                          static_cast<Eigen::Index>(session.luminaires.size()));
  for (size_t s = 0; s < by_state.size(); ++s) dimming.row(static_cast<Eigen::Index>(s)) = by_state[s];
  const Eigen::Index rank = dimming.fullPivLu().rank();
  if (rank == dimming.cols()) {
    findings.push_back(
        {Health::kGood, fmt::format("{} states tell {} luminaires apart", session.states.size(), rank), ""});
  } else {
    findings.push_back({Health::kNote,
                        fmt::format("{} luminaires, {} independent states: some are always on together",
                                    dimming.cols(), rank),
                        "photograph each alone, or give position_m of those"});
  }
}

void ExamineReadings(const Session& session, DoctorFindings& findings) {
  const auto& readings = session.luxmeter.readings;
  const auto count = [&](ReadingRole role) {
    return std::count_if(readings.begin(), readings.end(),
                         [&](const SessionReading& r) { return r.role == role && r.is_measured; });
  };
  const bool has_flux = std::any_of(session.luminaires.begin(), session.luminaires.end(),
                                    [](const SessionLuminaire& l) { return l.flux_lm.has_value(); });
  const bool has_camera = std::any_of(session.cameras.begin(), session.cameras.end(),
                                      [](const SessionCamera& c) { return c.cdm2_per_count_s > 0; });
  if (count(ReadingRole::kScale) + count(ReadingRole::kFit) > 0 || has_flux || has_camera) {
    findings.push_back(
        {Health::kGood,
         fmt::format("{} readings, {} of them only check", readings.size(), count(ReadingRole::kCheck)), ""});
  } else {
    findings.push_back({Health::kNote, "nothing fixes the absolute scale: fluxes will be relative",
                        "name one reading in luxmeter.scale, or give one flux_lm with flux_sigma_lm"});
  }
  if (count(ReadingRole::kCheck) == 0)
    findings.push_back(
        {Health::kNote, "no reading is left to check the result", "read the meter at a few more places"});
}

}  // namespace

std::vector<DoctorFinding> ExamineSession(const Session& session) {
  DoctorFindings findings;
  TrialFolder folder;
  ExamineRoom(session, folder.context(), findings);
  ExaminePhotometry(session, findings);
  ExamineCalibration(session, findings);
  ExaminePhotos(session, folder.context(), findings);
  if (!session.lights) {
    ExamineStates(session, findings);
    ExamineReadings(session, findings);
  }
  return findings;
}

}  // namespace luxfit
