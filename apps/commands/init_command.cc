#include "apps/commands/init_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "apps/commands/internal/photo_draft.h"
#include "apps/session/session.h"
#include "apps/session/session_draft.h"
#include "apps/session/session_files.h"
#include "apps/session/tag_map.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"
#include "apps/text/terminal.h"
#include "calib/lens/camera_file.h"
#include "forward/mesh/mesh_check.h"
#include "forward/mesh/mesh_file.h"
#include "forward/mesh/outline.h"
#include "forward/room/scene.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

void AddAreas(const Scene& scene, double scale, SessionDraft& draft) {
  for (const Facet& facet : scene.facets)
    draft.material_area_m2[scene.materials[static_cast<size_t>(facet.material)]] +=
        facet.AreaM2() * scale * scale;
}

// Returns the first unit in which the mesh is some metres wide, as a room is.
void GuessUnit(const Eigen::Vector3d& size, const std::vector<SurveyedTag>& survey, const Scene& scene,
               SessionDraft& draft) {
  const std::vector<std::pair<std::string, double>> units = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}};
  std::vector<Eigen::Vector3d> centers;
  centers.reserve(survey.size());
  for (const SurveyedTag& tag : survey) centers.push_back(tag.center_in_world);
  const SurveyCheck check = CheckSurvey(scene, centers, 1);
  for (const auto& [unit, metres] : units) {
    const double largest = size.maxCoeff() * metres;
    const bool by_tags = !centers.empty() && (check.fits ? unit == "m" : unit == check.better_unit);
    if (!by_tags && (!centers.empty() || largest > 50)) continue;
    draft.unit = unit;
    draft.unit_because = by_tags ? "the surveyed tags then lie on the mesh" : "a room is some metres wide";
    draft.size_m = size * metres;
    return;
  }
  draft.unit = "m";
  draft.unit_because = "nothing tells";
  draft.size_m = size;
}

void LookAtMesh(const InitCommandOptions& options, const std::vector<SurveyedTag>& survey,
                SessionDraft& draft) {
  const Scene scene = ReadScene(options.mesh);
  GuessUnit(scene.Bounds().sizes(), survey, scene, draft);
  const double scale =
      scene.Bounds().sizes().maxCoeff() > 0 ? draft.size_m.maxCoeff() / scene.Bounds().sizes().maxCoeff() : 1;
  AddAreas(scene, scale, draft);
}

// Reads "6", "4", "2.8" or "6x4x2.8".
Eigen::Vector3d SizeFrom(const std::vector<std::string>& words) {
  std::string text = fmt::format("{}", fmt::join(words, "x"));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'X' || c == '*'; }, 'x');
  Eigen::Vector3d size;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%lfx%lfx%lf%c", &size.x(), &size.y(), &size.z(), &rest);
  if (read == 3 && size.allFinite() && size.minCoeff() > 0) return size;
  throw std::runtime_error("--size: expected three lengths in m, got " +
                           Quoted(fmt::format("{}", fmt::join(words, " "))) +
                           "; write --size 6 4 2.8 (along x, along y, height)");
}

// Guesses the room as the upright box that the tags on walls span. Leaves the draft as it is where they span none.
void GuessSize(const std::vector<SurveyedTag>& survey, SessionDraft& draft) {
  constexpr size_t kFewestTags = 4;
  constexpr double kLeastLengthM = 1, kUsualHeightM = 2.5, kOriginM = 0.05, kAboveTagM = 0.1;
  Eigen::AlignedBox3d box;
  size_t on_walls = 0;
  double ceiling_m = 0;
  for (const SurveyedTag& tag : survey) {
    if (tag.normal_in_world.z() < -0.9) ceiling_m = std::max(ceiling_m, tag.center_in_world.z());
    if (std::abs(tag.normal_in_world.z()) > 0.3) continue;
    ++on_walls;
    box.extend(tag.center_in_world);
  }
  if (on_walls < kFewestTags || box.sizes().head<2>().minCoeff() < kLeastLengthM) return;
  const auto rounded = [](double metres) { return 0.001 * std::round(1000 * metres); };
  draft.corner_m = {rounded(box.min().x()), rounded(box.min().y())};
  if (draft.corner_m.cwiseAbs().maxCoeff() < kOriginM) draft.corner_m.setZero();
  draft.size_m.head<2>() << rounded(box.max().x()) - draft.corner_m.x(),
      rounded(box.max().y()) - draft.corner_m.y();
  draft.size_m.z() = ceiling_m > 0 ? ceiling_m : std::max(kUsualHeightM, rounded(box.max().z()) + kAboveTagM);
  draft.size_because = fmt::format("as far as {} tags on walls reach{}; measure the room", on_walls,
                                   ceiling_m > 0 ? "" : ", and a usual height");
}

// Sets the room of the draft: the mesh, the lengths that the user gives, or a guess from the tags.
void LookAtRoom(const InitCommandOptions& options, SessionDraft& draft) {
  const std::vector<SurveyedTag> survey =
      options.tags.empty() ? std::vector<SurveyedTag>{} : ReadTagMap(options.tags);
  if (!options.mesh.empty()) return LookAtMesh(options, survey, draft);
  if (options.size.empty()) {
    GuessSize(survey, draft);
  } else {
    draft.size_m = SizeFrom(options.size);
  }
  if (draft.size_m.isZero())
    throw std::runtime_error(
        fmt::format("--size: expected the room's three lengths (or a mesh, or a map of 4 or more tags on its "
                    "walls), got none; "
                    "measure along x, along y and the height in m, and type: luxfit init --photos {}{} "
                    "--size 6 4 2.8 -o {}",
                    options.photos, options.tags.empty() ? "" : " --tags " + options.tags, options.out));
  AddAreas(SceneFrom(OutlineOfBox(draft.size_m)), 1, draft);
}

// Finds files of intrinsics beside the photos, the mesh or the session, of the photos' size.
void LookForIntrinsics(const InitCommandOptions& options, SessionDraft& draft) {
  std::set<fs::path> folders = {fs::absolute(options.photos).lexically_normal(),
                                fs::absolute(options.photos).lexically_normal().parent_path(),
                                fs::absolute(options.out)};
  if (!options.mesh.empty()) folders.insert(fs::absolute(options.mesh).parent_path());
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string ending = ExtensionOf(entry.path().string());
      if (ending != ".yaml" && ending != ".yml" && ending != ".cameramodel" && ending != ".xml") continue;
      try {
        const Camera camera = ReadCamera(entry.path().string());
        for (const DraftPhoto& photo : draft.photos) {
          if (photo.width_px == camera.width_px && photo.height_px == camera.height_px)
            draft.intrinsics[photo.camera] = fs::relative(entry.path(), options.out).string();
        }
      } catch (const std::runtime_error&) {
        continue;  // another kind of YAML
      }
    }
  }
}

void ExpectNew(const std::string& folder) {
  for (const char* name : {"session.toml", "photos.csv"}) {
    if (fs::exists(fs::path(folder) / name))
      throw std::runtime_error(
          (fs::path(folder) / name).string() +
          ": expected a new file, found one; init writes over nothing: give another folder by -o");
  }
}

std::string ReadingsFile(const std::string& folder) { return (fs::path(folder) / "luxmeter.csv").string(); }

}  // namespace

int InitCommand(const InitCommandOptions& options) {
  if (!fs::is_directory(options.photos))
    throw std::runtime_error("--photos: expected a folder, got " + Quoted(options.photos));
  ExpectNew(options.out);
  SessionDraft draft;
  const bool has_readings = fs::exists(ReadingsFile(options.out));
  if (has_readings) draft.readings = FilledReadings(ReadingsFile(options.out));
  LookAtRoom(options, draft);
  fs::create_directories(options.out);
  draft.name = fs::absolute(options.out).lexically_normal().filename().string();
  if (draft.name.empty())
    draft.name = fs::absolute(options.out).lexically_normal().parent_path().filename().string();
  draft.mesh = options.mesh.empty() ? "" : fs::relative(options.mesh, options.out).string();
  draft.tags = options.tags.empty() ? "" : fs::relative(options.tags, options.out).string();
  DraftPhotos(options.photos, options.out, draft);
  LookForIntrinsics(options, draft);
  const fs::path folder(options.out);
  WriteText((folder / "photos.csv").string(), PhotoTable(draft));
  if (!has_readings) WriteText(ReadingsFile(options.out), ReadingsTemplate());
  WriteText((folder / "session.toml").string(), SessionText(draft));
  const std::vector<std::string> to_do = ToDo(draft);
  std::string text =
      fmt::format("{}: {} photos, {} states, {} materials, tags {}\n", (folder / "session.toml").string(),
                  draft.photos.size(), draft.states.size(), draft.material_area_m2.size(),
                  draft.seen_tags.empty() ? "none seen" : fmt::format("{}", fmt::join(draft.seen_tags, " ")));
  if (draft.tone_mapped.mapped > 0)
    text += fmt::format("warning: {} do not tell light: {}\n         remedy: {}\n", draft.tone_mapped.Names(),
                        ToneMappingInWords(draft.tone_mapped.sign), kToneMappingRemedy);
  text += "check the lines that end in GUESS; then:\n";
  for (const std::string& item : to_do) text += "- " + item + "\n";
  if (options.json)
    text = JsonText(nlohmann::json{{"session", (folder / "session.toml").string()}, {"to_do", to_do}});
  PrintText(text);
  return 0;
}

}  // namespace luxfit
