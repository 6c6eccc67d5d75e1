#include <nlohmann/json.hpp>

#include "apps/export/exports.h"
#include "apps/export/value_mesh.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_text.h"

namespace luxfit {
namespace {

using nlohmann::json;

std::vector<CsvColumn> VectorColumns(const std::string& prefix, const std::string& unit,
                                     const std::string& pointer) {
  return {{prefix + "x" + unit, pointer + "/0"},
          {prefix + "y" + unit, pointer + "/1"},
          {prefix + "z" + unit, pointer + "/2"}};
}

std::vector<CsvColumn> Joined(const std::vector<std::vector<CsvColumn>>& parts) {
  std::vector<CsvColumn> columns;
  for (const auto& part : parts) columns.insert(columns.end(), part.begin(), part.end());
  return columns;
}

std::vector<CsvColumn> LuminaireColumns(bool is_absolute) {
  std::vector<CsvColumn> flux{{"flux_relative", "/flux_relative"}};
  if (is_absolute) flux = {{"flux_lm", "/flux_lm"}, {"flux_sigma_lm", "/flux_sigma_lm"}};
  return Joined({{{"id", "/id"}},
                 VectorColumns("", "_m", "/position_m"),
                 VectorColumns("sigma_", "_m", "/position_sigma_m"),
                 VectorColumns("aim_", "", "/aim"),
                 {{"aim_sigma_along_deg", "/aim_sigma_deg/0"}, {"aim_sigma_across_deg", "/aim_sigma_deg/1"}},
                 VectorColumns("heading_", "", "/heading"),
                 {{"heading_sigma_deg", "/heading_sigma_deg"}},
                 flux,
                 {{"photometry", "/photometry"},
                  {"cosine_exponent", "/cosine_exponent"},
                  {"cosine_exponent_sigma", "/cosine_exponent_sigma"},
                  {"shape", "/shape"},
                  {"size_along_m", "/size_m/0"},
                  {"size_across_m", "/size_m/1"},
                  {"ies", "/files/ies"},
                  {"ldt", "/files/ldt"}}});
}

std::vector<CsvColumn> ViewColumns() {
  std::vector<CsvColumn> rotation;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c)
      rotation.push_back({"scene_from_camera_r" + std::to_string(r + 1) + std::to_string(c + 1),
                          "/R_scene_from_camera/" + std::to_string(r) + "/" + std::to_string(c)});
  }
  return Joined(
      {{{"view", "/view"}, {"camera", "/camera"}},
       VectorColumns("", "_m", "/position_m"),
       VectorColumns("sigma_", "_m", "/position_sigma_m"),
       rotation,
       {{"method", "/method"}, {"tags", "/tags"}, {"reprojection_rms_px", "/reprojection_rms_px"}}});
}

// Returns the readings of the result with their places, which only the session has.
json Readings(const FittedRoom& fitted) {
  json readings = fitted.result->at("luxmeter");
  const std::vector<SessionReading>& given = fitted.session.luxmeter.readings;
  for (json& reading : readings) {
    for (const SessionReading& r : given) {
      if (reading.at("id") != r.id || reading.at("state") != r.state) continue;
      reading["position_m"] = {r.position_m.x(), r.position_m.y(), r.position_m.z()};
      reading["normal"] = {r.normal.x(), r.normal.y(), r.normal.z()};
      break;
    }
  }
  return readings;
}

std::vector<CsvColumn> ReadingColumns() {
  return Joined({{{"id", "/id"}, {"state", "/state"}, {"role", "/role"}},
                 VectorColumns("", "_m", "/position_m"),
                 VectorColumns("n", "", "/normal"),
                 {{"measured_lx", "/measured_lx"},
                  {"measured_sigma_lx", "/measured_sigma_lx"},
                  {"predicted_lx", "/predicted_lx"},
                  {"prediction_sigma_lx", "/prediction_sigma_lx"},
                  {"lower95_lx", "/interval95_lx/0"},
                  {"upper95_lx", "/interval95_lx/1"},
                  {"direct_lx", "/direct_lx"},
                  {"z", "/z"}}});
}

json Timing(const json& result) {
  json rows = json::array();
  for (const auto& [stage, seconds] : result.at("timing_s").items())
    rows.push_back({{"stage", stage}, {"time_s", seconds}});
  return rows;
}

std::string PatchCsv(const FittedRoom& fitted) {
  const std::string unit = fitted.is_absolute ? "lx" : "relative";
  std::vector<std::string> fields{"patch", "material", "x_m", "y_m",     "z_m",
                                  "nx",    "ny",       "nz",  "area_m2", "albedo"};
  const PlaceLight& light = fitted.light->AtElements();
  std::vector<Eigen::VectorXd> columns;
  for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
    const Eigen::Index column = static_cast<Eigen::Index>(k);
    fields.push_back(CsvField("illuminance_" + unit + " of " + fitted.luminaires[k].id));
    columns.push_back(PatchMeans(fitted.room.patches, light.total_lx.col(column)));
    fields.push_back(CsvField("direct_" + unit + " of " + fitted.luminaires[k].id));
    columns.push_back(PatchMeans(fitted.room.patches, light.direct_lx.col(column)));
  }
  std::string text = CsvLine(fields);
  for (size_t p = 0; p < fitted.room.patches.patches.size(); ++p) {
    const Patch& patch = fitted.room.patches.patches[p];
    const Eigen::Vector3d normal = patch.edge_u.cross(patch.edge_v).normalized();
    fields = {std::to_string(p), CsvField(fitted.room.scene.materials[static_cast<size_t>(patch.material)])};
    for (const double v : {patch.center.x(), patch.center.y(), patch.center.z(), normal.x(), normal.y(),
                           normal.z(), patch.area_m2, fitted.albedo[patch.material]})
      fields.push_back(CsvField(v));
    for (const Eigen::VectorXd& column : columns)
      fields.push_back(CsvField(column[static_cast<Eigen::Index>(p)]));
    text += CsvLine(fields);
  }
  return text;
}

}  // namespace

ExportedFiles ExportTables(const FittedRoom& fitted, const std::string& folder) {
  const json& result = *fitted.result;
  ExportedFiles exported;
  const auto write = [&](const std::string& name, const std::string& text) {
    WriteText(folder + "/" + name, text);
    exported.files.push_back(folder + "/" + name);
  };
  write("luminaires.csv", CsvOf(result.at("luminaires"), LuminaireColumns(fitted.is_absolute)));
  write("materials.csv", CsvOf(result.at("materials"), {{"name", "/name"},
                                                        {"albedo", "/albedo"},
                                                        {"sigma", "/sigma"},
                                                        {"albedo_red", "/albedo_rgb/0"},
                                                        {"albedo_green", "/albedo_rgb/1"},
                                                        {"albedo_blue", "/albedo_rgb/2"},
                                                        {"albedo_in_model", "/albedo_in_model"},
                                                        {"source", "/source"}}));
  write("views.csv", CsvOf(result.at("views"), ViewColumns()));
  write("luxmeter.csv", CsvOf(Readings(fitted), ReadingColumns()));
  write("choices.csv",
        CsvOf(result.at("choices"),
              {{"what", "/what"}, {"chosen", "/chosen"}, {"among", "/among"}, {"because", "/because"}}));
  write("warnings.csv",
        CsvOf(result.at("warnings"), {{"code", "/code"}, {"message", "/message"}, {"remedy", "/remedy"}}));
  write("timing.csv", CsvOf(Timing(result), {{"stage", "/stage"}, {"time_s", "/time_s"}}));
  write("patches.csv", PatchCsv(fitted));
  return exported;
}

}  // namespace luxfit
