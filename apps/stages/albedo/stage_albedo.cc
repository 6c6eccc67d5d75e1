#include "apps/stages/albedo/stage_albedo.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/text/formats/json_vectors.h"
#include "inverse/albedo/patch_albedo.h"

namespace luxfit {
namespace {

using nlohmann::json;

json MaterialJson(const std::string& name, const MaterialAlbedo& material) {
  json scores = json::array();
  for (const DetailScore& s : material.scores) {
    scores.push_back({{"detail", ToString(s.detail)},
                      {"score", NumberOrNull(s.score)},
                      {"standard_error", NumberOrNull(s.standard_error)},
                      {"texture", NumberOrNull(s.texture)}});
  }
  return {{"name", name},
          {"albedo_from_radiosity", NumberOrNull(material.albedo)},
          {"albedo_from_radiosity_sigma", NumberOrNull(material.sigma)},
          {"detail", ToString(material.detail)},
          {"observations", material.observations},
          {"elements", material.elements},
          {"unlike_elements", material.unlike_elements},
          {"scores", scores},
          {"because", material.because}};
}

// Writes one row for each unit; columns that do not apply are empty.
std::string AlbedoCsv(const Room& room, const PatchAlbedo& albedo, const json& fitted) {
  std::string text = "material,detail,facet,patch,element,x_m,y_m,z_m,albedo,sigma,source\n";
  const auto row = [&](const std::string& material, AlbedoDetail detail, const std::string& place,
                       const std::string& value, const std::string& sigma, const std::string& source) {
    text += fmt::format("{},{},{},{},{},{}\n", material, ToString(detail), place, value, sigma, source);
  };
  const auto number = [](const json& value) {
    return value.is_number() ? fmt::format("{:.5f}", value.get<double>()) : std::string();
  };
  for (size_t m = 0; m < albedo.materials.size(); ++m) {
    const json& material = fitted[m];
    const std::string name = room.scene.materials[m];
    const AlbedoDetail detail = albedo.materials[m].detail;
    row(name, AlbedoDetail::kMaterial, ",,,,,", number(material["albedo"]), number(material["sigma"]),
        material["source"].get<std::string>());
    if (detail == AlbedoDetail::kMaterial) continue;
    for (const AlbedoUnit& unit : albedo.units) {
      if (unit.material != static_cast<int>(m)) continue;
      const Patch& patch = room.patches.patches[static_cast<size_t>(unit.patch)];
      const bool is_element = unit.element >= 0;
      const Eigen::Vector3d at =
          is_element ? room.patches.elements[static_cast<size_t>(unit.element)].center : patch.center;
      row(name, detail,
          fmt::format("{},{},{},{:.4f},{:.4f},{:.4f}", patch.facet, unit.patch,
                      is_element ? std::to_string(unit.element) : "", at.x(), at.y(), at.z()),
          fmt::format("{:.5f}", unit.albedo), fmt::format("{:.5f}", unit.sigma), "estimated");
    }
  }
  return text;
}

void Record(const Room& room, const PatchAlbedo& albedo, RunContext& context) {
  for (size_t m = 0; m < albedo.materials.size(); ++m) {
    const MaterialAlbedo& material = albedo.materials[m];
    if (material.observations == 0) continue;
    const std::string& name = room.scene.materials[m];
    context.choices.push_back({"albedo detail of " + name,
                               ToString(material.detail),
                               {"material", "patch", "element"},
                               material.because});
    if (!material.IsUneven()) continue;
    context.warnings.push_back(
        {"surface_unlike_its_material",
         fmt::format(
             "{} of {} observed elements of \"{}\" reflect more or less than the rest by 10 % or more",
             material.unlike_elements, material.elements, name),
         "see albedo.csv for where; something hangs or stands there that the mesh lacks, or the material is "
         "several: give it a name of its own in the mesh"});
  }
}

}  // namespace

json AlbedoOfRoom(const Session& session, const Room& room, const RoomFit& fit, const json& result,
                  RunContext& context) {
  json artifact = ProvenanceJson("luxfit-albedo-1", context.provenance);
  artifact["session"] = session.name;
  artifact["materials"] = json::array();
  if (!fit.fit.IsUsable() || fit.data.observations.empty()) {
    artifact["message"] = "no finer albedo without a fit to photos that stands";
    WriteJson(context.out + "/stages/albedo.json", artifact);
    return artifact;
  }
  const StageTimer timer(context, "albedo", "albedo by material, patch and element");
  const PatchAlbedo albedo = EstimatePatchAlbedo(room, fit.data, fit.fit);
  for (size_t m = 0; m < albedo.materials.size(); ++m)
    artifact["materials"].push_back(MaterialJson(room.scene.materials[m], albedo.materials[m]));
  artifact["relative_model_error"] = albedo.model_error;
  Record(room, albedo, context);
  WriteText(context.out + "/albedo.csv", AlbedoCsv(room, albedo, result["materials"]));
  WriteJson(context.out + "/stages/albedo.json", artifact);
  return artifact;
}

json WithAlbedo(json result, const json& artifact, const RunContext& context) {
  for (json& material : result["materials"]) {
    for (const json& finer : artifact["materials"]) {
      if (finer["name"] != material["name"]) continue;
      for (const char* key :
           {"detail", "albedo_from_radiosity", "albedo_from_radiosity_sigma", "unlike_elements", "elements"})
        material[key] = finer[key];
    }
  }
  AddStatus(context, result);
  result["choices"] = ChoicesJson(context);
  result["warnings"] = WarningsJson(context);
  result["timing_s"] = context.timing_s;
  return result;
}

std::string AlbedoTable(const json& result) {
  const auto text_of = [](const json& value) {
    return value.is_number() ? fmt::format("{:.4f}", value.get<double>()) : std::string("-");
  };
  std::string text = StatusLine(result) + fmt::format("\n{:<16} {:>8} {:>8}  {:>14} {:>8}  {:<10} {}\n",
                                                      "material", "albedo", "sigma", "from radiosity",
                                                      "sigma", "detail", "unlike the rest");
  for (const json& m : result["materials"]) {
    const bool finer = m.contains("detail");
    text += fmt::format(
        "{:<16} {:>8} {:>8}  {:>14} {:>8}  {:<10} {}\n", m["name"].get<std::string>(), text_of(m["albedo"]),
        text_of(m["sigma"]), finer ? text_of(m["albedo_from_radiosity"]) : "-",
        finer ? text_of(m["albedo_from_radiosity_sigma"]) : "-", finer ? m["detail"].get<std::string>() : "-",
        finer ? fmt::format("{} of {} elements", m["unlike_elements"].get<int>(), m["elements"].get<int>())
              : "");
  }
  return text + WarningText(result);
}

}  // namespace luxfit
