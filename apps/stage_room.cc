#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/stages.h"
#include "inverse/survey_check.h"

namespace luxfit {
namespace {

double NowS() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void CheckTagsLieOnMesh(const Session& session, const Scene& scene) {
  std::vector<Eigen::Vector3d> centers;
  for (const SurveyedTag& tag : session.tags.survey) centers.push_back(tag.center_in_world);
  const SurveyCheck check = CheckSurvey(scene, centers, session.scene->metres_per_unit);
  if (check.fits) return;
  const std::string mend = check.better_unit.empty()
                               ? "check that mesh and tag map share one frame"
                               : fmt::format("the mesh fits with unit = \"{}\"", check.better_unit);
  throw std::runtime_error(
      fmt::format("{}: scene.unit: expected the surveyed tags to lie on the mesh, but with unit = \"{}\" "
                  "a quarter of them are {:.3g} m and more away; {}",
                  session.path, session.scene->unit, check.distance_m, mend));
}

}  // namespace

StageTimer::StageTimer(RunContext& context, std::string stage, const std::string& line)
    : context_(context), stage_(std::move(stage)), start_s_(NowS()) {
  if (!line.empty()) std::fprintf(stderr, "%-9s %s\n", stage_.c_str(), line.c_str());
}

StageTimer::~StageTimer() { context_.timing_s[stage_] += NowS() - start_s_; }

Room LoadRoom(const Session& session, RunContext& context) {
  if (!session.scene) return MakeRoom(Scene{});
  const StageTimer timer(context, "scene", session.scene->mesh);
  Scene scene = ReadScene(session.scene->mesh, session.scene->metres_per_unit);
  CheckTagsLieOnMesh(session, scene);
  if (scene.dropped_facets > 0) {
    context.warnings.push_back({"facets_dropped",
                                fmt::format("{} facets without area were left out", scene.dropped_facets),
                                "none needed; clean the mesh to silence this"});
  }
  const RoomOptions options;
  Room room = MakeRoom(std::move(scene), options);
  context.choices.push_back({"patches",
                             fmt::format("{} patches up to {:g} m, {} elements up to {:g} m",
                                         room.patches.patches.size(), options.patches.patch_size_m,
                                         room.patches.elements.size(), options.patches.element_size_m),
                             {},
                             "indirect light varies over patches, direct light over elements; "
                             "docs/accuracy.md tells what finer ones change"});
  context.choices.push_back(
      {"bounces", "all", {}, "the radiosity system is factored once: every bounce costs the same as one"});
  if (room.form_factors.escaped_fraction > 0.01) {
    context.warnings.push_back({"open_mesh",
                                fmt::format("{:.1f} % of the rays between surfaces leave the room",
                                            100 * room.form_factors.escaped_fraction),
                                "close the mesh, or expect less interreflection than the real room has"});
  }
  if (room.form_factors.back_fraction > 0.05) {
    context.warnings.push_back(
        {"flipped_facets",
         fmt::format("{:.1f} % of the rays between surfaces meet the back of a facet",
                     100 * room.form_factors.back_fraction),
         "turn the facets so that their corners run counter-clockwise seen from inside the room"});
  }
  return room;
}

}  // namespace luxfit
