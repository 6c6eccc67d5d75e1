#include "apps/commands/result/dim_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/commands/internal/design_file.h"
#include "apps/commands/internal/level_plan.h"
#include "apps/export/fit_uncertainty.h"
#include "apps/session/report_targets.h"
#include "apps/session/session_files.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_table.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/suggest.h"
#include "inverse/control/dimming.h"

namespace luxfit {
namespace {

using nlohmann::json;

Gaze GazeOf(const std::string& id, const Eigen::Vector3d& eye_m, const Eigen::Vector3d& direction,
            const std::string& place) {
  if (!(direction.norm() > 0))
    throw std::runtime_error(place + ": expected a direction of the gaze, got 0, 0, 0; correct it");
  return {id, eye_m, direction.normalized()};
}

Gaze GazeOfText(const std::string& text, size_t number) {
  std::vector<double> values;
  std::istringstream fields(text);
  for (std::string field; std::getline(fields, field, ',');) {
    std::istringstream stream(field);
    double value = 0;
    if (!(stream >> value) || !(stream >> std::ws).eof() || !std::isfinite(value)) break;
    values.push_back(value);
  }
  if (values.size() != 6 || std::count(text.begin(), text.end(), ',') != 5)
    throw std::runtime_error(
        "--person: expected a file, or x,y,z,dx,dy,dz (eye in m, direction of the gaze), got " +
        Quoted(text) + "; write six numbers such as 3,2,1.2,-1,0,0");
  return GazeOf("person " + std::to_string(number), {values[0], values[1], values[2]},
                {values[3], values[4], values[5]}, "--person");
}

std::vector<Gaze> GazesOfTable(const std::string& path) {
  const CsvTable table = ReadCsvTable(path, {{"id", "x_m", "y_m", "z_m", "dx", "dy", "dz"}, {}});
  std::vector<Gaze> gazes;
  for (const CsvRow& row : table.rows) {
    const auto vector = [&](const char* x, const char* y, const char* z) {
      return Eigen::Vector3d(CsvNumber(table, row, x), CsvNumber(table, row, y), CsvNumber(table, row, z));
    };
    gazes.push_back(GazeOf(CsvText(table, row, "id"), vector("x_m", "y_m", "z_m"), vector("dx", "dy", "dz"),
                           path + ":" + std::to_string(row.line)));
  }
  return gazes;
}

std::vector<Gaze> GazesOf(const DimCommandOptions& options) {
  std::vector<Gaze> gazes;
  for (const std::string& person : options.persons) {
    const std::string extension = ExtensionOf(person);
    if (extension == ".csv") {
      const std::vector<Gaze> more = GazesOfTable(person);
      gazes.insert(gazes.end(), more.begin(), more.end());
    } else if (extension == ".toml") {
      for (const TargetObserver& o : ReadTargets(person).observers)
        gazes.push_back({o.id, o.eye_m, o.looking});
    } else {
      gazes.push_back(GazeOfText(person, gazes.size() + 1));
    }
  }
  if (gazes.empty())
    throw std::runtime_error("--person: expected somebody, got nobody; write x,y,z,dx,dy,dz or a file");
  return gazes;
}

void ExpectInRoom(const FittedRoom& fitted, const std::vector<Gaze>& gazes) {
  if (fitted.room.scene.facets.empty()) return;
  const Eigen::AlignedBox3d box = fitted.room.scene.Bounds();
  for (const Gaze& gaze : gazes) {
    if (box.contains(gaze.eye_m)) continue;
    throw std::runtime_error(fmt::format(
        "--person: expected eyes within the room ({:g} to {:g}, {:g} to {:g}, {:g} to {:g} m), got {} at "
        "{:g}, {:g}, {:g}",
        box.min().x(), box.max().x(), box.min().y(), box.max().y(), box.min().z(), box.max().z(), gaze.id,
        gaze.eye_m.x(), gaze.eye_m.y(), gaze.eye_m.z()));
  }
}

// Returns one row for each person and luminaire, with the luminaire's share of the light that reaches the
// eye.
json SharesJson(const FittedRoom& fitted, const std::vector<Gaze>& gazes, const EyeLight& eyes,
                const Eigen::MatrixXd& direct_lx, const Eigen::VectorXd& now) {
  json shares = json::array();
  for (size_t p = 0; p < gazes.size(); ++p) {
    const Eigen::Index row = static_cast<Eigen::Index>(p);
    const double sum = eyes.light_lx.row(row).dot(now);
    for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
      const Eigen::Index i = static_cast<Eigen::Index>(k);
      const double lx = eyes.light_lx(row, i) * now[i], direct = direct_lx(row, i) * now[i];
      shares.push_back({{"person", gazes[p].id},
                        {"luminaire", fitted.luminaires[k].id},
                        {"eye_lx", lx},
                        {"direct_lx", direct},
                        {"indirect_lx", lx - direct},
                        {"share", sum > 0 ? lx / sum : 0},
                        {"in_view", static_cast<bool>(eyes.in_view(row, i))}});
    }
  }
  return shares;
}

std::string DimmingTable(const json& result) {
  std::string text = fmt::format(
      "state {}: drop at each eye up to {:g} %\n\nperson       luminaire  at the eye "
      "lx   direct  indirect  share %  in view\n",
      result["state"].get<std::string>(), result["drop_percent"].get<double>());
  for (const json& s : result["shares"])
    text +=
        fmt::format("{:<12} {:<10} {:>13.2f} {:>8.2f} {:>9.2f} {:>8.1f}  {}\n",
                    s["person"].get<std::string>(), s["luminaire"].get<std::string>(),
                    s["eye_lx"].get<double>(), s["direct_lx"].get<double>(), s["indirect_lx"].get<double>(),
                    100 * s["share"].get<double>(), s["in_view"].get<bool>() ? "yes" : "no");
  text += "\nluminaire    now  alone down to  together down to  power W\n";
  for (const json& l : result["luminaires"])
    text += fmt::format("{:<10} {:>5.2f} {:>14.2f} {:>17.2f} {:>8.1f}\n", l["id"].get<std::string>(),
                        l["now"].get<double>(), l["alone"].get<double>(), l["together"].get<double>(),
                        l["power_w"].get<double>());
  for (const json& p : result["persons"])
    text += fmt::format("{}: light at the eye {:.1f} lx, drops by {:.1f} {}\n", p["id"].get<std::string>(),
                        p["eye_lx"].get<double>(), 100 * p["drop"].get<double>(),
                        p["drop_sigma"].is_number()
                            ? fmt::format("± {:.2f} %", 100 * p["drop_sigma"].get<double>())
                            : "% (how surely is not determined)");
  const double before = result["power_before_w"].get<double>();
  return text + fmt::format("{:.1f} W of {:.1f} W: {:.1f} % saved\n", result["power_w"].get<double>(), before,
                            before > 0 ? 100 * (1 - result["power_w"].get<double>() / before) : 0);
}

}  // namespace

int DimCommand(const DimCommandOptions& options) {
  const std::vector<Gaze> gazes = GazesOf(options);
  const FittedRoom fitted = ReadFittedRoom(options.out, options.session);
  ExpectInRoom(fitted, gazes);
  const std::string state = options.state.empty() ? BrightestState(fitted) : options.state;
  const Eigen::VectorXd now = DimmingOf(fitted, state);
  std::vector<Sensor> sensors;
  sensors.reserve(gazes.size());
  for (const Gaze& gaze : gazes) sensors.push_back({gaze.eye_m, gaze.direction});
  const PlaceLight light = fitted.light->LightAt(sensors);
  EyeLight eyes{light.While(now), {}};
  eyes.in_view.resize(light.total_lx.rows(), light.total_lx.cols());
  for (size_t p = 0; p < gazes.size(); ++p) {
    for (size_t k = 0; k < fitted.luminaires.size(); ++k)
      eyes.in_view(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(k)) =
          IsInView(fitted.room.rays, fitted.luminaires[k], gazes[p]);
  }
  std::map<std::string, double> given_w;
  if (!options.design.empty()) given_w = ReadDesign(options.design, fitted.session).power_w;
  const Eigen::VectorXd power_w = PowerOf(fitted, given_w);
  const UnseenDimming unseen = DimUnseen(eyes, now, power_w, options.drop_percent / 100,
                                         FluxCovariance(ReadFitUncertainty(fitted.out), fitted.luminaires));
  json result = ProvenanceJson("luxfit-dim-1", {options.command_line, {fitted.out + "/result.json"}});
  result["state"] = state;
  result["drop_percent"] = options.drop_percent;
  result["shares"] = SharesJson(fitted, gazes, eyes, light.direct_lx, now);
  result["luminaires"] = json::array();
  for (size_t k = 0; k < fitted.luminaires.size(); ++k) {
    const Eigen::Index i = static_cast<Eigen::Index>(k);
    result["luminaires"].push_back({{"id", fitted.luminaires[k].id},
                                    {"now", now[i]},
                                    {"alone", unseen.alone[i]},
                                    {"together", unseen.dimming[i]},
                                    {"in_view", static_cast<bool>(eyes.in_view.col(i).any())},
                                    {"power_w", power_w[i] * unseen.dimming[i]}});
  }
  result["persons"] = json::array();
  bool is_lit = true;
  for (size_t p = 0; p < gazes.size(); ++p) {
    const double eye_lx = eyes.light_lx.row(static_cast<Eigen::Index>(p)).dot(now);
    is_lit = is_lit && eye_lx > 0;
    result["persons"].push_back({{"id", gazes[p].id},
                                 {"eye_lx", eye_lx},
                                 {"drop", unseen.drop[p]},
                                 {"drop_sigma", NumberOrNull(unseen.drop_sigma[p])}});
  }
  result["power_w"] = unseen.power_w;
  result["power_before_w"] = unseen.power_before_w;
  const std::string folder =
      std::filesystem::absolute(options.folder.empty() ? fitted.out + "/dim" : options.folder)
          .lexically_normal()
          .string();
  WriteText(folder + "/luminaires.csv", CsvOf(result["luminaires"], {{"id", "/id"},
                                                                     {"now", "/now"},
                                                                     {"alone", "/alone"},
                                                                     {"together", "/together"},
                                                                     {"power_w", "/power_w"}}));
  WriteText(folder + "/persons.csv", CsvOf(result["shares"], {{"person", "/person"},
                                                              {"luminaire", "/luminaire"},
                                                              {"eye_lx", "/eye_lx"},
                                                              {"direct_lx", "/direct_lx"},
                                                              {"indirect_lx", "/indirect_lx"},
                                                              {"share", "/share"}}));
  WriteJson(folder + "/dim.json", result);
  std::fputs(options.json ? JsonText(result).c_str() : DimmingTable(result).c_str(), stdout);
  std::fprintf(stderr, "done      %s\n", (folder + "/dim.json").c_str());
  return is_lit ? 0 : 1;
}

}  // namespace luxfit
