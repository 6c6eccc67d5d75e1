#include "apps/commands/room_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "apps/charts/plan_svg.h"
#include "apps/commands/doctor_command.h"
#include "apps/session/session_files.h"
#include "apps/session/session_scene.h"
#include "apps/stages/stages.h"
#include "apps/text/file_stem.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"
#include "apps/text/terminal.h"
#include "forward/mesh/mesh_check.h"
#include "forward/mesh/mesh_file.h"
#include "forward/mesh/named_planes.h"
#include "forward/mesh/planes.h"
#include "forward/mesh/ray_shares.h"

namespace luxfit {
namespace {

using nlohmann::json;

struct ExaminedRoom {
  std::string name, is;  // `is`: the mesh, or what the outline consists of
  Scene scene;           // facets drawn on one another are cut
  std::vector<double> material_area_m2;
  std::optional<double> volume_m3;  // absent where the surfaces enclose none
  int facets = 0;                   // as given
  bool is_on_planes = false;        // a scan
  std::vector<DoctorFinding> findings;
};

void AddFindings(const Scene& given, ExaminedRoom& room) {
  bool encloses = true;
  Scene surface = room.scene;
  surface.facets = SurfaceFacets(room.scene);
  surface.surface.clear();
  for (const MeshFinding& finding :
       JudgedByRays(CheckMesh(given), room.is_on_planes, EstimateRayShares(surface))) {
    const bool is_black =
        finding.defect == MeshDefect::kFlippedFacets || finding.defect == MeshDefect::kInsideOut;
    const bool is_open = finding.defect == MeshDefect::kOpenMesh && finding.affects_light;
    encloses = encloses && !is_black && !is_open;
    if (is_black || is_open || finding.affects_light || finding.defect == MeshDefect::kFacetsDropped)
      room.findings.push_back(
          {is_black ? Health::kBad : Health::kNote, finding.message + "; " + finding.effect, finding.remedy});
  }
  if (!encloses) return;
  room.volume_m3 = surface.VolumeM3();
  room.findings.insert(room.findings.begin(), {Health::kGood, "the surfaces close and face the room", ""});
}

// Makes the scene as `run` does.
void Layout(const SessionScene& said, const Scene& given, ExaminedRoom& room) {
  room.facets = static_cast<int>(given.facets.size());
  room.is_on_planes = IsFinerThanPatches(given, {});
  PlanesOptions options;
  options.named_material = MaterialWithoutPaints(said, given);
  room.scene = room.is_on_planes ? LayOnPlanes(given, options).scene
                                 : WithPlanesNamed(WithoutOverlaps(given), options.named_material);
}

ExaminedRoom Examine(const RoomCommandOptions& options) {
  ExaminedRoom room;
  Scene given;
  SessionScene said;
  std::string complaint;
  if (ExtensionOf(options.file) == ".toml") {
    const Session session = ReadSession(options.file);
    if (!session.scene)
      throw InputError({options.file}, "scene",
                       "expected what the room is, got no [scene]; add it with size, outline or mesh");
    room.name = session.name;
    room.is = RoomText(*session.scene);
    said = *session.scene;
    given = SceneOf(said);
    complaint = SurveyComplaint(session, given);
  } else {
    room.name = FileName(options.file);
    room.is = options.file;
    given = ReadScene(options.file, MetresPerUnit(options.unit, "--unit"));
  }
  Layout(said, given, room);
  room.material_area_m2.assign(room.scene.materials.size(), 0);
  for (const Facet& facet : room.scene.facets)
    room.material_area_m2[static_cast<size_t>(facet.material)] += facet.AreaM2();
  AddFindings(given, room);
  if (!complaint.empty()) room.findings.push_back({Health::kBad, complaint, ""});
  return room;
}

const char* NameOf(Health health) {
  return health == Health::kGood ? "good" : (health == Health::kNote ? "note" : "bad");
}

std::string TextOf(const ExaminedRoom& room) {
  const Eigen::Vector3d size = room.scene.Bounds().sizes();
  std::string text = fmt::format(
      "{}: {:.2f} x {:.2f} x {:.2f} m, {} facets{}, {} materials; {}\n", room.name, size.x(), size.y(),
      size.z(), room.is_on_planes ? room.facets : static_cast<int>(room.scene.facets.size()),
      room.is_on_planes ? fmt::format(" on {} planes", room.scene.facets.size()) : "",
      room.scene.materials.size(), room.is);
  text += room.volume_m3 ? fmt::format("volume {:.2f} m3\n", *room.volume_m3)
                         : "volume -: the surfaces do not enclose it\n";
  size_t width = 0;
  for (const std::string& name : room.scene.materials) width = std::max(width, name.size());
  for (size_t m = 0; m < room.scene.materials.size(); ++m)
    text += fmt::format("  {:<{}}  {:8.2f} m2\n", room.scene.materials[m], width, room.material_area_m2[m]);
  for (const DoctorFinding& finding : room.findings) {
    text += fmt::format("{:<5} {}\n", NameOf(finding.health), finding.what);
    if (!finding.remedy.empty()) text += "      " + finding.remedy + "\n";
  }
  return text;
}

json JsonOf(const ExaminedRoom& room) {
  const Eigen::Vector3d size = room.scene.Bounds().sizes();
  json materials = json::array(), findings = json::array();
  for (size_t m = 0; m < room.scene.materials.size(); ++m)
    materials.push_back({{"name", room.scene.materials[m]}, {"area_m2", room.material_area_m2[m]}});
  for (const DoctorFinding& finding : room.findings)
    findings.push_back({{"health", NameOf(finding.health)}, {"what", finding.what}, {"fix", finding.remedy}});
  return {{"name", room.name},
          {"room", room.is},
          {"size_m", {size.x(), size.y(), size.z()}},
          {"facets", room.scene.facets.size()},
          {"volume_m3", room.volume_m3 ? json(*room.volume_m3) : json()},
          {"materials", materials},
          {"findings", findings}};
}

}  // namespace

int RoomCommand(const RoomCommandOptions& options) {
  if (!options.plan.empty() && ExtensionOf(options.plan) != ".svg")
    throw std::runtime_error("--out: expected a file name ending in .svg, got " + Quoted(options.plan));
  const ExaminedRoom room = Examine(options);
  if (!options.plan.empty()) WriteText(options.plan, RoomPlanSvg(room.name, room.scene));
  PrintText(options.json ? JsonText(JsonOf(room)) : TextOf(room));
  const bool is_bad = std::any_of(room.findings.begin(), room.findings.end(),
                                  [](const DoctorFinding& f) { return f.health == Health::kBad; });
  return is_bad ? 1 : 0;
}

}  // namespace luxfit
