#include "apps/internal/session_scene.h"

#include <vector>

#include "apps/internal/session_files.h"
#include "apps/tag_map.h"

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

}  // namespace

const std::map<std::string, double>& MetresPerUnit() {
  static const std::map<std::string, double> metres{
      {"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  return metres;
}

SessionScene ReadSceneSection(const TomlCursor& section, const std::string& folder) {
  section.ExpectKeys({"mesh", "unit", "albedo"});
  SessionScene scene;
  scene.mesh = AbsolutePath(FindFile(section.Require("mesh", "a mesh file (OBJ, PLY, glTF)"), folder));
  if (const auto unit = section.Find("unit")) {
    scene.unit = unit->OneOf({"m", "cm", "mm", "in", "ft"});
    scene.metres_per_unit = MetresPerUnit().at(scene.unit);
  }
  scene.line = section.place().line;
  if (const auto albedo = section.Find("albedo")) {
    scene.line = albedo->place().line;
    for (const auto& [material, value] : albedo->Members())
      scene.known_albedo_rgb[material] = ReadAlbedo(value);
  }
  return scene;
}

SessionTags ReadTagsSection(const TomlCursor& section, const std::string& folder) {
  section.ExpectKeys({"family", "map", "size_m"});
  SessionTags tags;
  if (const auto family = section.Find("family"))
    tags.family = family->OneOf({"tag36h11", "tag36h10", "tag25h9", "tag16h5", "tagStandard41h12"});
  if (const auto size = section.Find("size_m")) size->NumberAbove(0, "m");
  const auto map = section.Find("map");
  if (!map)
    throw InputError(
        section.place(), "tags.map",
        "expected a tag map, got nothing: estimating where the tags hang is not available in this version; "
        "survey them and add map = \"tags.json\"");
  const std::string map_path = FindFile(*map, folder);
  tags.survey = ReadTagMap(map_path);
  tags.map_path = AbsolutePath(map_path);
  return tags;
}

std::string ReadRegistrationSection(const TomlCursor& section) {
  section.ExpectKeys({"method", "colmap"});
  if (const auto model = section.Find("colmap")) {
    model->Text("the folder of a COLMAP model");
    throw NotAvailable(*model, "registration by tags alone; remove the key");
  }
  const auto method = section.Find("method");
  if (!method) return "auto";
  std::string name = method->OneOf({"auto", "tags", "colmap", "both"});
  if (name == "colmap" || name == "both") throw NotAvailable(*method, "\"auto\" or \"tags\"");
  return name;
}

}  // namespace luxfit
