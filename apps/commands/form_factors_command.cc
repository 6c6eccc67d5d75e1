#include "apps/commands/form_factors_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/session/session_scene.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/seconds.h"
#include "apps/text/suggest.h"
#include "forward/factors/form_factors.h"
#include "forward/mesh/mesh_check.h"
#include "forward/room/scene.h"

namespace luxfit {
namespace {

using nlohmann::json;

FormFactorMethod MethodFrom(const std::string& name) {
  if (const auto method = FormFactorMethodFrom(name)) return *method;
  std::vector<std::string> names;
  for (const FormFactorOps& ops : FormFactorMethods()) names.emplace_back(ops.name);
  throw std::runtime_error("--method: " + ExpectedOneOf(names, name));
}

void Warn(const std::vector<MeshFinding>& findings) {
  for (const MeshFinding& finding : findings) {
    if (finding.affects_light)
      fmt::print(stderr, "warning: {}; {}\n         remedy: {}\n", finding.message, finding.effect,
                 finding.remedy);
  }
}

struct Computed {
  Scene scene;
  Patches patches;
  FormFactors factors;
  double time_s = 0;
};

// Checks the size of the matrix, which has a row and a column for each patch.
void ExpectMatrixSize(const Scene& scene, const FormFactorsCommandOptions& options) {
  constexpr double kMostPatches = 30000;  // 3.6 GB
  double patches = 0;
  for (const Facet& facet : scene.facets)
    patches += std::max(1.0, facet.AreaM2() / (options.patch_size_m * options.patch_size_m));
  if (patches <= kMostPatches) return;
  throw std::runtime_error(
      fmt::format("{}: expected at most {:.0f} patches, got {} facets that make some {:.0f} with "
                  "--patch-size {:g}; raise it, or "
                  "leave out details",
                  options.mesh, kMostPatches, scene.facets.size(), patches, options.patch_size_m));
}

Computed Compute(const FormFactorsCommandOptions& options) {
  FormFactorOptions how;
  how.method = MethodFrom(options.method);
  how.rays_per_element = options.rays;
  Computed computed;
  const Scene given = SceneOfFile(options.mesh, MetresPerUnit(options.unit, "--unit"));
  // Facets that lie on one another would both send light; they are removed as in MakeRoom.
  computed.scene = WithoutOverlaps(given);
  ExpectMatrixSize(computed.scene, options);
  const RayScene rays(computed.scene);
  computed.patches = Subdivide(computed.scene, rays, {options.patch_size_m, options.patch_size_m});
  const double start_s = NowS();
  computed.factors = ComputeFormFactors(rays, computed.patches, how);
  computed.time_s = NowS() - start_s;
  Warn(WithRayShares(CheckMesh(given), RaySharesOf(computed.factors)));
  return computed;
}

json Summary(const FormFactorsCommandOptions& options, const Computed& computed) {
  json summary = ProvenanceJson("luxfit-formfactors-1", {options.command_line, {options.mesh}});
  const FormFactors& factors = computed.factors;
  summary["method"] = ToString(factors.method);
  if (!factors.because.empty()) summary["because"] = factors.because;
  summary["patch_size_m"] = options.patch_size_m;
  summary["patches"] = computed.patches.patches.size();
  summary["rays"] = factors.rays;
  summary["time_s"] = computed.time_s;
  summary["closure_error"] = factors.closure_error;
  summary["reciprocity_error"] = ReciprocityError(computed.patches, factors);
  summary["escaped_fraction"] = factors.escaped_fraction;
  summary["back_fraction"] = factors.back_fraction;
  return summary;
}

json PatchesJson(const Computed& computed) {
  json list = json::array();
  for (const Patch& patch : computed.patches.patches) {
    list.push_back({{"facet", patch.facet},
                    {"material", computed.scene.materials[static_cast<size_t>(patch.material)]},
                    {"area_m2", patch.area_m2},
                    {"center_m", {patch.center.x(), patch.center.y(), patch.center.z()}}});
  }
  return list;
}

json MatrixJson(const FormFactorMatrix& matrix) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back(std::vector<float>(matrix.row(i).data(), matrix.row(i).data() + matrix.cols()));
  }
  return rows;
}

std::string Csv(const Computed& computed) {
  fmt::memory_buffer text;
  const auto out = fmt::appender(text);
  fmt::format_to(out, "patch,facet,material,area_m2,x_m,y_m,z_m");
  for (size_t j = 0; j < computed.patches.patches.size(); ++j) fmt::format_to(out, ",f_{}", j);
  fmt::format_to(out, "\n");
  for (size_t i = 0; i < computed.patches.patches.size(); ++i) {
    const Patch& patch = computed.patches.patches[i];
    fmt::format_to(out, "{},{},{},{:.6g},{:.6g},{:.6g},{:.6g}", i, patch.facet,
                   computed.scene.materials[static_cast<size_t>(patch.material)], patch.area_m2,
                   patch.center.x(), patch.center.y(), patch.center.z());
    for (const float f : computed.factors.element_to_patch.row(static_cast<Eigen::Index>(i))) {
      fmt::format_to(out, ",{:.7g}", f);
    }
    fmt::format_to(out, "\n");
  }
  return fmt::to_string(text);
}

}  // namespace

int FormFactorsCommand(const FormFactorsCommandOptions& options) {
  const std::string extension = std::filesystem::path(options.file).extension().string();
  if (extension != ".csv" && extension != ".json") {
    throw std::runtime_error(
        fmt::format("--out: expected a file name ending in .csv or .json, got {}", Quoted(options.file)));
  }
  const Computed computed = Compute(options);
  json summary = Summary(options, computed);
  if (extension == ".csv") {
    WriteText(options.file, Csv(computed));
  } else {
    json whole = summary;
    whole["patch_list"] = PatchesJson(computed);
    whole["form_factors"] = MatrixJson(computed.factors.element_to_patch);
    WriteJson(options.file, whole);
  }
  if (options.json) {
    fmt::print("{}", JsonText(summary));
    return 0;
  }
  fmt::print("{} patches, {}, {:.3g} M rays, {:.3g} s\n", computed.patches.patches.size(),
             ToString(computed.factors.method), static_cast<double>(computed.factors.rays) * 1e-6,
             computed.time_s);
  if (!computed.factors.because.empty()) fmt::print("because {}\n", computed.factors.because);
  fmt::print("closure error {:.2g} (1 - row sum, rms, before it is enforced), reciprocity error {:.2g}\n",
             computed.factors.closure_error, summary["reciprocity_error"].get<double>());
  if (computed.factors.escaped_fraction > 0)
    fmt::print("{:.3g} % of the hemispheres see no surface: the mesh is open\n",
               100 * computed.factors.escaped_fraction);
  return 0;
}

}  // namespace luxfit
