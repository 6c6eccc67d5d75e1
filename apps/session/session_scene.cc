#include "apps/session/session_scene.h"

#include <array>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/session/internal/session_outline.h"
#include "apps/session/session_files.h"
#include "apps/session/tag_map.h"
#include "apps/text/suggest.h"
#include "forward/mesh/mesh_file.h"

namespace luxfit {
namespace {

Eigen::Vector3d ReadAlbedo(const TomlCursor& value) {
  Eigen::Vector3d albedo_rgb =
      value.IsArray() ? value.Vector("a reflectance: a number or [r, g, b]")
                      : Eigen::Vector3d::Constant(value.Number("a reflectance: a number or [r, g, b]"));
  if (albedo_rgb.minCoeff() < 0 || albedo_rgb.maxCoeff() > 1)
    throw value.Error("expected a reflectance in 0..1, got " + value.Shown() + "; 25 % is written 0.25");
  if (albedo_rgb.maxCoeff() == 1)
    throw value.Error(
        "expected a reflectance below 1, got " + value.Shown() +
        ": a closed room that absorbs nothing has no solution; white paint reflects 0.85 to 0.9");
  return albedo_rgb;
}

constexpr std::array<std::pair<const char*, double>, 5> kMetresPerUnit = {
    {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};

std::vector<std::string> UnitNames() {
  std::vector<std::string> names;
  names.reserve(kMetresPerUnit.size());
  for (const auto& [name, metres] : kMetresPerUnit) names.emplace_back(name);
  return names;
}

}  // namespace

double MetresPerUnit(const std::string& unit, const std::string& key) {
  for (const auto& [name, metres] : kMetresPerUnit)
    if (name == unit) return metres;
  throw std::runtime_error(key + ": " + ExpectedOneOf(UnitNames(), unit));
}

SessionScene ReadSceneSection(const TomlCursor& section, const std::string& folder) {
  section.ExpectKeys({"mesh", "size", "outline", "height", "box", "opening", "unit", "albedo", "furniture",
                      "materials", "neutral"});
  SessionScene scene;
  if (const auto unit = section.Find("unit")) {
    scene.unit = unit->OneOf(UnitNames());
    scene.metres_per_unit = MetresPerUnit(scene.unit, "scene.unit");
  }
  scene.outline = ReadOutline(section, scene.metres_per_unit);
  if (const auto mesh = section.Find("mesh")) scene.mesh = AbsolutePath(FindFile(*mesh, folder));
  if (const auto furniture = section.Find("furniture"))
    scene.finds_furniture = furniture->OneOf({"find", "given"}) == "find";
  if (const auto materials = section.Find("materials"))
    scene.names_planes = materials->OneOf({"find", "given"}) == "find";
  if (const auto neutral = section.Find("neutral")) {
    for (const TomlCursor& name : neutral->Elements("a list of materials, such as [\"ceiling\"]"))
      scene.neutral.push_back(name.Text("a material"));
  }
  scene.line = section.place().line;
  if (const auto albedo = section.Find("albedo")) {
    scene.line = albedo->place().line;
    for (const auto& [material, value] : albedo->Members())
      scene.known_albedo_rgb[material] = ReadAlbedo(value);
  }
  return scene;
}

Scene SceneOf(const SessionScene& scene) {
  Scene given = scene.outline ? SceneFrom(*scene.outline) : ReadScene(scene.mesh, scene.metres_per_unit);
  if (scene.mesh_move) given = WithMeshMoved(std::move(given), *scene.mesh_move);
  Scene standing = WithPiecesMoved(WithPlanesMoved(std::move(given), scene.walls), scene.moves);
  return WithPaintedRectangles(WithBoxes(standing, scene.furniture), scene.parts);
}

std::string RoomText(const SessionScene& scene) {
  if (!scene.outline) return scene.mesh;
  const std::string corners = std::to_string(scene.outline->corners_m.size());
  return "an outline of " + corners + " corners, with " + std::to_string(scene.outline->boxes.size()) +
         " boxes and " + std::to_string(scene.outline->rectangles.size()) + " openings";
}

Scene SceneOfFile(const std::string& path, double metres_per_unit) {
  if (ExtensionOf(path) != ".toml") return ReadScene(path, metres_per_unit);
  const Session session = ReadSession(path);
  if (session.scene) return SceneOf(*session.scene);
  throw InputError({path}, "scene", "expected [scene] with mesh, size or outline, got none; add it");
}

SessionTags ReadTagsSection(const TomlCursor& section, const std::string& folder) {
  section.ExpectKeys({"family", "map", "size_m"});
  SessionTags tags;
  if (const auto family = section.Find("family"))
    tags.family = family->OneOf({"tag36h11", "tag36h10", "tag25h9", "tag16h5", "tagStandard41h12"});
  if (const auto size = section.Find("size_m")) tags.size_m = size->NumberAbove(0, "m");
  const auto map = section.Find("map");
  if (!map && tags.size_m == 0)
    throw InputError(
        section.place(), "tags.map",
        "expected a tag map, or the tags' size so that their places can be estimated, got neither; add "
        "map = \"tags.json\" or size_m = ...");
  if (!map) return tags;
  const std::string map_path = FindFile(*map, folder);
  tags.survey = ReadTagMap(map_path);
  tags.map_path = AbsolutePath(map_path);
  return tags;
}

SessionRegistration ReadRegistrationSection(const TomlCursor& section, const std::string& folder) {
  section.ExpectKeys({"method", "colmap", "start"});
  SessionRegistration registration;
  if (const auto method = section.Find("method"))
    registration.method = method->OneOf({"auto", "tags", "colmap", "both"});
  if (const auto model = section.Find("colmap")) {
    const std::string name = model->Text("the folder of a COLMAP model");
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::error_code error;
    if (!std::filesystem::is_directory(path, error))
      throw model->Error("expected the folder of a COLMAP model, found none at " + Quoted(path.string()) +
                         "; name it, or remove the key to have COLMAP run");
    if (registration.method == "tags")
      throw model->Error("expected no COLMAP model beside method = \"tags\", got " + model->Shown() +
                         "; method = \"both\" uses it");
    registration.colmap_model = AbsolutePath(path.string());
  }
  if (const auto start = section.Find("start")) {
    for (const auto& [view, position] : start->Members())
      registration.start_positions_m[view] =
          position.Vector("where the camera roughly stood, [x, y, z] in m");
    if (registration.start_positions_m.size() < 3)
      throw start->Error("expected the rough places of three views or more, got " +
                         std::to_string(registration.start_positions_m.size()) +
                         "; write start = { v00 = [x, y, z], ... }");
  }
  return registration;
}

}  // namespace luxfit
