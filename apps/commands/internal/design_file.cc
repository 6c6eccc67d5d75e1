#include "apps/commands/internal/design_file.h"

#include <filesystem>

#include "apps/session/session_luminaires.h"
#include "apps/stages/simulate/given_session.h"
#include "apps/text/formats/toml_reader.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

Sensor PlaceOf(const TomlCursor& table, const std::string& id, const Session& session) {
  if (const auto position = table.Find("position_m")) {
    const auto normal = table.Find("normal");
    return {position->Vector("a point [x, y, z]"),
            normal ? normal->Direction("a direction [x, y, z]") : Eigen::Vector3d(0, 0, 1)};
  }
  std::vector<std::string> known;
  for (const SessionReading& reading : session.luxmeter.readings) {
    if (reading.id == id) return {reading.position_m, reading.normal, session.luxmeter.response};
    known.push_back(reading.id);
  }
  throw table.Error("expected position_m, or the id of a place of the luxmeter, got " + Quoted(id) +
                    DidYouMean(id, known) + "; add position_m = [x, y, z]");
}

DesignPoint ReadPoint(const TomlCursor& table, const Session& session) {
  table.ExpectKeys({"id", "position_m", "normal", "illuminance_lx"});
  DesignPoint point;
  point.id = table.Require("id", "a name").Text("a name");
  point.illuminance_lx = table.Require("illuminance_lx", "the light it needs, in lx").NumberAbove(0, "lx");
  point.sensor = PlaceOf(table, point.id, session);
  return point;
}

std::vector<Luminaire> ReadDesigned(const TomlCursor& root, const std::string& path,
                                    const std::string& folder) {
  if (!root.Find("luminaire")) return {};
  Session design;
  design.path = path;
  design.luminaires = ReadLuminaires(root, folder).luminaires;
  RunContext context;
  context.is_quiet = true;
  return GivenLuminaires(design, "commission", context);
}

}  // namespace

LightingDesign ReadDesign(const std::string& path, const Session& session) {
  const toml::table document = ReadTomlFile(path);
  const TomlCursor root(document, {path, 1}, "");
  root.ExpectKeys({"name", "luminaire", "power_w", "point"});
  LightingDesign design;
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  design.luminaires = ReadDesigned(root, path, folder.string());
  if (const auto power = root.Find("power_w")) {
    for (const auto& [id, value] : power->Members()) design.power_w[id] = value.NumberAbove(0, "W");
  }
  if (const auto points = root.Find("point")) {
    for (const TomlCursor& table : points->Elements("a list of tables [[point]]"))
      design.points.push_back(ReadPoint(table, session));
  }
  if (design.luminaires.empty() && design.points.empty())
    throw root.Error("expected luminaires or points, got neither; add [[luminaire]] or [[point]]");
  return design;
}

}  // namespace luxfit
