#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/session/session_scene.h"
#include "apps/stages/stages.h"
#include "apps/text/seconds.h"
#include "apps/text/suggest.h"
#include "apps/text/terminal.h"
#include "forward/mesh/mesh_check.h"
#include "forward/mesh/named_planes.h"
#include "forward/mesh/planes.h"
#include "forward/room/patches.h"
#include "forward/room/scene.h"
#include "inverse/observe/as_if/mesh_as_if.h"

namespace luxfit {
namespace {

// Returns the key that says what the room is.
std::string RoomKey(const Session& session) {
  return session.scene->outline ? "scene.outline" : "scene.mesh";
}

std::string RemedyOf(const SurveyCheck& check, const Scene& scene, const std::vector<SurveyedTag>& survey,
                     bool is_mesh) {
  if (!check.better_unit.empty())
    return fmt::format("the {} fits with unit = \"{}\"", is_mesh ? "mesh" : "room", check.better_unit);
  if (!is_mesh)
    return "measure the room's lengths again; the floor is z = 0, size has a corner at the tag map's origin, "
           "and "
           "outline puts the corners elsewhere";
  if (check.fits_y_up) return "the tags lie on it where the mesh's y axis is up: export the mesh with z up";
  const std::vector<MeshExplanation> as_if = MeshAsIfByTags(scene, survey);
  if (as_if.empty()) return "check that mesh and tag map share one frame";
  return fmt::format("{} of {} tags lie on it where the mesh is {}: {}", as_if.front().tags_on_mesh,
                     survey.size(), NamesOf(as_if), RemedyOf(as_if));
}

// Tells whether the room is cut into so few elements that form factors, elements x patches x 4 bytes, may fit in memory.
// Triangles that share a plane are merged first, as the light's computation does.
bool IsOfUsualSize(const Scene& scene) {
  constexpr double kMostElements = 1e6;
  const PatchesOptions options;
  if (CountPatches(scene, options).elements <= kMostElements) return true;
  const Eigen::Vector3d size = scene.Bounds().sizes();
  const double box_m2 = 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  if (box_m2 > kMostElements * std::pow(options.element_size_m, 2)) return false;
  return CountPatches(WithTrianglesMerged(scene), options).elements <= kMostElements;
}

// Refuses a room in millimetres that is read as metres: its form factors would take petabytes.
void ExpectRoomSize(const Session& session, const Scene& scene) {
  if (IsOfUsualSize(scene)) return;
  const Eigen::Vector3d size = scene.Bounds().sizes();
  throw std::runtime_error(
      fmt::format("{}: scene.unit: expected a room of up to 10000 m2 of surface, but with unit = \"{}\" the "
                  "room is {:.4g} m x {:.4g} m x {:.4g} m; check the unit, and whether a corner lies far off "
                  "all others",
                  session.path, session.scene->unit, size.x(), size.y(), size.z()));
}

void RecordPlaneNames(const std::string& material, const Room& room, RunContext& context) {
  context.choices.push_back(
      {"materials",
       fmt::format("{} materials, by planes", room.scene.materials.size()),
       {"a reflectance for each plane", "one for all"},
       material == kDefaultMaterial
           ? "the mesh has no materials, and floor, ceiling and walls are seldom of one paint"
           : fmt::format(
                 "the mesh gives all surfaces the material {}, and floor, ceiling and walls are seldom of "
                 "one paint; materials = \"given\" under [scene] keeps it",
                 material)});
}

}  // namespace

void RunContext::Add(const Findings& more) {
  warnings.insert(warnings.end(), more.warnings.begin(), more.warnings.end());
  choices.insert(choices.end(), more.choices.begin(), more.choices.end());
}

StageTimer::StageTimer(RunContext& context, std::string stage, const std::string& line)
    : context_(context), stage_(std::move(stage)), start_s_(NowS()) {
  if (line.empty() || context.is_quiet) return;
  if (context.progress) context.progress->HandOver();
  const auto last = context.expected_s.find(stage_);
  progress_ = std::make_shared<ProgressLine>(fmt::format("{:<9} {}", stage_, line),
                                             last == context.expected_s.end() ? 0 : last->second);
  context.progress = progress_;
}

StageTimer::~StageTimer() {
  context_.timing_s[stage_] += NowS() - start_s_;
  if (progress_ && context_.progress == progress_) context_.progress.reset();
}

void Advance(const RunContext& context, size_t total) {
  if (context.progress) context.progress->Advance(static_cast<int>(total));
}

void Say(const RunContext& context, const std::string& words) {
  if (context.progress) context.progress->Say(words);
}

std::string SurveyComplaint(const Session& session, const Scene& scene) {
  std::vector<Eigen::Vector3d> centers;
  for (const SurveyedTag& tag : session.tags.survey) centers.push_back(tag.center_in_world);
  const SurveyCheck check = CheckSurvey(scene, centers, session.scene->metres_per_unit);
  if (check.fits) return "";
  const bool is_mesh = !session.scene->outline;
  return fmt::format(
      "{}: {}: expected the surveyed tags to lie on the {}, but with unit = \"{}\" "
      "a quarter of them are {:.3g} m and more away; {}",
      session.path, is_mesh ? "scene.unit" : RoomKey(session), is_mesh ? "mesh" : "room's surfaces",
      session.scene->unit, check.distance_m, RemedyOf(check, scene, session.tags.survey, is_mesh));
}

LoadedMesh LoadMesh(const Session& session) {
  LoadedMesh mesh;
  mesh.scene = SceneOf(*session.scene);
  const std::string complaint = SurveyComplaint(session, mesh.scene);
  if (!complaint.empty()) throw std::runtime_error(complaint);
  ExpectRoomSize(session, mesh.scene);
  mesh.findings = CheckMesh(mesh.scene);
  return mesh;
}

void WarnOfUnknownMaterials(const Session& session, const std::vector<std::string>& materials,
                            RunContext& context) {
  if (!session.scene) return;
  for (const auto& [name, albedo] : session.scene->known_albedo_rgb) {
    if (std::count(materials.begin(), materials.end(), name) > 0) continue;
    context.warnings.push_back({"unknown_material",
                                fmt::format("scene.albedo.{}: the room has no such material", name),
                                "remove it, or correct the name" + DidYouMean(name, materials)});
  }
  for (const std::string& name : session.scene->neutral) {
    if (std::count(materials.begin(), materials.end(), name) > 0) continue;
    context.warnings.push_back({"unknown_material",
                                fmt::format("scene.neutral: the room has no material \"{}\"", name),
                                "remove it, or correct the name" + DidYouMean(name, materials)});
  }
}

std::vector<MeshFinding> JudgedByRays(std::vector<MeshFinding> findings, bool is_on_planes,
                                      RayShares shares) {
  if (is_on_planes) {
    // Holes were closed. What slits are left loses less light than the surface errs.
    constexpr double kSlitsShare = 0.01;
    findings.erase(std::remove_if(findings.begin(), findings.end(),
                                  [](const MeshFinding& f) { return f.defect == MeshDefect::kOpenMesh; }),
                   findings.end());
    if (shares.escaped < kSlitsShare) shares.escaped = 0;
  }
  return WithRayShares(std::move(findings), shares);
}

void WarnOfMesh(std::vector<MeshFinding> findings, const Room& room, RunContext& context) {
  const RayShares shares = RaySharesOf(room.form_factors);
  for (const MeshFinding& finding : JudgedByRays(std::move(findings), room.on_planes.has_value(), shares)) {
    if (finding.affects_light || finding.defect == MeshDefect::kFacetsDropped)
      context.warnings.push_back(
          {ToString(finding.defect), finding.message + "; " + finding.effect, finding.remedy});
  }
}

std::string MaterialWithoutPaints(const SessionScene& scene, const Scene& mesh) {
  std::string sole = SoleMaterialOf(mesh);
  return scene.names_planes && scene.known_albedo_rgb.count(sole) == 0 ? sole : "";
}

Room LoadRoom(const Session& session, RunContext& context) {
  if (!session.scene) return MakeRoom(Scene{});
  const StageTimer timer(context, "scene", RoomText(*session.scene));
  const LoadedMesh mesh = LoadMesh(session);
  RoomOptions options;
  options.planes.emplace();
  options.planes->named_material = MaterialWithoutPaints(*session.scene, mesh.scene);
  Room room = MakeRoom(mesh.scene, options);
  if (room.sparse) {
    throw std::runtime_error(
        fmt::format("{}: {}: expected patches whose form factors fit into {:.0f} GB, got {} patches "
                    "of {} facets; leave "
                    "out details, or merge them (luxfit simulate takes such meshes as they are)",
                    session.path, RoomKey(session), 1e-9 * options.max_matrix_bytes,
                    room.patches.patches.size(), room.scene.facets.size()));
  }
  context.choices.push_back({"patches",
                             fmt::format("{} patches up to {:g} m, {} elements up to {:g} m",
                                         room.patches.patches.size(), options.patches.patch_size_m,
                                         room.patches.elements.size(), options.patches.element_size_m),
                             {},
                             "indirect light varies over patches, direct light over elements; "
                             "docs/accuracy.md tells what finer ones change"});
  if (room.on_planes) {
    context.choices.push_back(
        {"surface",
         fmt::format("{} planes for {} facets of the mesh, {:.2g} mm off (rms); {} holes closed",
                     room.scene.facets.size(), room.on_planes->triangles, 1000 * room.on_planes->rms_m,
                     room.on_planes->closed_holes),
         {},
         "facets finer than patches tell light nothing; their errors average out over a plane"});
  }
  if (!options.planes->named_material.empty())
    RecordPlaneNames(options.planes->named_material, room, context);
  WarnOfMesh(mesh.findings, room, context);
  // Who misspells the mesh's own material is shown that.
  std::vector<std::string> names = room.scene.materials;
  if (!options.planes->named_material.empty()) names.push_back(options.planes->named_material);
  WarnOfUnknownMaterials(session, names, context);
  return room;
}

}  // namespace luxfit
