#include "apps/commands/result/commission_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/commands/internal/design_file.h"
#include "apps/commands/internal/level_plan.h"
#include "apps/commands/internal/light_targets.h"
#include "apps/export/fit_uncertainty.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/csv_text.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/suggest.h"
#include "inverse/control/commissioning.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kDegrees = 180 / M_PI;

double NumberOf(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

MeasuredLuminaire MeasuredOf(const Luminaire& luminaire, const json& entry) {
  MeasuredLuminaire measured;
  measured.luminaire = luminaire;
  for (Eigen::Index i = 0; i < 3; ++i)
    measured.position_sigma_m[i] = NumberOf(entry.at("position_sigma_m").at(static_cast<size_t>(i)));
  measured.relative_flux_sigma = NumberOf(entry.at("flux_sigma_lm")) / luminaire.flux_lm;
  if (entry.contains("aim_sigma_deg"))
    measured.aim_sigma_rad =
        std::hypot(NumberOf(entry["aim_sigma_deg"][0]), NumberOf(entry["aim_sigma_deg"][1])) / kDegrees;
  if (entry.contains("heading_sigma_deg"))
    measured.heading_sigma_rad = NumberOf(entry["heading_sigma_deg"]) / kDegrees;
  if (entry.contains("cosine_exponent_sigma") && entry["cosine_exponent_sigma"].is_number()) {
    Luminaire other = luminaire;
    other.cosine_exponent += entry["cosine_exponent_sigma"].get<double>();
    measured.distribution_sigma = DistributionDistance(luminaire, other);
  }
  return measured;
}

std::vector<MeasuredLuminaire> MeasuredIn(const FittedRoom& fitted) {
  std::vector<MeasuredLuminaire> measured;
  for (const Luminaire& luminaire : fitted.luminaires) {
    for (const json& entry : fitted.result->at("luminaires")) {
      if (entry.at("id") == luminaire.id) measured.push_back(MeasuredOf(luminaire, entry));
    }
  }
  return measured;
}

json IntervalJson(const ToleranceInterval& interval, double factor) {
  if (!interval.is_determined) return nullptr;
  return {{"value", factor * interval.value},
          {"half_width95", NumberOrNull(factor * interval.half_width)},
          {"tolerance", factor * interval.tolerance}};
}

std::string Sentence(CommissioningFault fault, const CommissionedLuminaire& verdict,
                     const std::vector<Luminaire>& designed) {
  const auto with = [](const ToleranceInterval& interval, double factor, const char* unit) {
    return fmt::format("by {:.3g} ± {:.2g} {}", factor * interval.value, factor * interval.half_width, unit);
  };
  switch (fault) {
    case CommissioningFault::kOff:
      return verdict.measured < 0 ? "no light: nothing shines there" : "no light";
    case CommissioningFault::kMoved:
      return "moved " + with(verdict.moved_m, 1, "m");
    case CommissioningFault::kAimTurned:
      return "aim turned " + with(verdict.aim_rad, kDegrees, "deg");
    case CommissioningFault::kHeadingTurned:
      return "heading turned " + with(verdict.heading_rad, kDegrees, "deg");
    case CommissioningFault::kWeak:
      return "dimmed or weak: flux " + with(verdict.flux_ratio_less_1, 100, "%");
    case CommissioningFault::kStrong:
      return "too strong: flux " + with(verdict.flux_ratio_less_1, 100, "%");
    case CommissioningFault::kPhotometry:
      return "wrong photometry: light goes elsewhere " + with(verdict.distribution, 100, "% of the flux");
    case CommissioningFault::kSwapped:
      return "swapped with " + designed[static_cast<size_t>(verdict.swapped_with)].id;
  }
  return "";
}

json VerdictJson(const CommissionedLuminaire& verdict, const std::vector<Luminaire>& designed,
                 const std::vector<MeasuredLuminaire>& measured) {
  json faults = json::array(), sentences = json::array();
  for (const CommissioningFault fault : verdict.faults) {
    faults.push_back(ToString(fault));
    sentences.push_back(Sentence(fault, verdict, designed));
  }
  json entry = {{"id", designed[static_cast<size_t>(verdict.designed)].id},
                {"fitted_id", nullptr},
                {"verdict", verdict.faults.empty() ? "ok" : "faulty"},
                {"faults", faults},
                {"because", sentences}};
  if (verdict.measured < 0) return entry;
  entry["fitted_id"] = measured[static_cast<size_t>(verdict.measured)].luminaire.id;
  entry["moved_m"] = IntervalJson(verdict.moved_m, 1);
  entry["aim_deg"] = IntervalJson(verdict.aim_rad, kDegrees);
  entry["heading_deg"] = IntervalJson(verdict.heading_rad, kDegrees);
  entry["flux_percent"] = IntervalJson(verdict.flux_ratio_less_1, 100);
  entry["distribution_percent"] = IntervalJson(verdict.distribution, 100);
  return entry;
}

json ComparisonJson(const FittedRoom& fitted, const std::vector<Luminaire>& designed) {
  const std::vector<MeasuredLuminaire> measured = MeasuredIn(fitted);
  const Commissioning commissioning = CompareWithDesign(designed, measured);
  json comparison = {{"luminaires", json::array()},
                     {"undesigned", json::array()},
                     {"common_flux_ratio", commissioning.common_flux_ratio}};
  for (const CommissionedLuminaire& verdict : commissioning.luminaires)
    comparison["luminaires"].push_back(VerdictJson(verdict, designed, measured));
  for (const int j : commissioning.undesigned)
    comparison["undesigned"].push_back(measured[static_cast<size_t>(j)].luminaire.id);
  return comparison;
}

std::string ComparisonText(const json& comparison) {
  std::string text = "luminaire  fitted as  moved m  aim deg  flux %           light elsewhere %  verdict\n";
  const auto value = [](const json& entry, const char* key, const char* format) {
    if (!entry.contains(key) || entry[key].is_null()) return std::string("-");
    return fmt::format(fmt::runtime(format), NumberOf(entry[key]["value"]),
                       NumberOf(entry[key]["half_width95"]));
  };
  for (const json& l : comparison["luminaires"]) {
    std::string verdict;
    for (const json& sentence : l["because"])
      verdict += (verdict.empty() ? "" : "; ") + sentence.get<std::string>();
    text += fmt::format("{:<10} {:<10} {:>7}  {:>7}  {:<16} {:>17}  {}\n", l["id"].get<std::string>(),
                        l["fitted_id"].is_null() ? "-" : l["fitted_id"].get<std::string>(),
                        value(l, "moved_m", "{:.3f}"), value(l, "aim_deg", "{:.1f}"),
                        value(l, "flux_percent", "{:+.1f} ± {:.1f}"),
                        value(l, "distribution_percent", "{:.1f}"), verdict.empty() ? "ok" : verdict);
  }
  for (const json& id : comparison["undesigned"])
    text += "luminaire " + id.get<std::string>() + " shines, but is not in the design\n";
  return text;
}

std::string ComparisonCsv(const json& comparison) {
  std::vector<CsvColumn> columns{{"id", "/id"}, {"fitted_id", "/fitted_id"}, {"verdict", "/verdict"}};
  for (const char* of : {"moved_m", "aim_deg", "heading_deg", "flux_percent", "distribution_percent"}) {
    columns.push_back({of, std::string("/") + of + "/value"});
    columns.push_back({std::string(of) + "_half_width95", std::string("/") + of + "/half_width95"});
  }
  columns.push_back({"because", "/because"});
  return CsvOf(comparison["luminaires"], columns);
}

}  // namespace

int CommissionCommand(const CommissionCommandOptions& options) {
  const FittedRoom fitted = ReadFittedRoom(options.out, options.session);
  if (!fitted.is_absolute)
    throw std::runtime_error(fitted.out +
                             "/result.json: luminaires: expected fluxes in lm, got relative ones; give a "
                             "luxmeter reading the role scale and run `luxfit run` again");
  if (options.design.empty() && options.targets.empty())
    throw std::runtime_error("--design: expected a design, or --targets, got neither; name one");
  LightingDesign design;
  std::vector<TargetArea> areas;
  Provenance provenance{options.command_line, {fitted.out + "/result.json"}};
  if (!options.design.empty()) design = ReadDesign(options.design, fitted.session);
  if (!options.targets.empty()) areas = ReadTargets(options.targets).areas;
  for (const std::string& file : {options.design, options.targets}) {
    if (!file.empty())
      provenance.inputs.push_back(std::filesystem::absolute(file).lexically_normal().string());
  }
  const std::string folder =
      std::filesystem::absolute(options.folder.empty() ? fitted.out + "/commission" : options.folder)
          .lexically_normal()
          .string();
  json result = ProvenanceJson("luxfit-commission-1", provenance);
  std::string text;
  if (!design.luminaires.empty()) {
    result["comparison"] = ComparisonJson(fitted, design.luminaires);
    text += ComparisonText(result["comparison"]);
    WriteText(folder + "/luminaires.csv", ComparisonCsv(result["comparison"]));
  }
  bool is_reached = true;
  const RoomTargets targets = TargetsOf(fitted, design.points, areas);
  if (!targets.requirements.empty()) {
    result["levels"] = LevelPlanJson(fitted, targets, design.power_w);
    is_reached = result["levels"]["reached"].get<bool>();
    text += LevelPlanText(result["levels"]);
    WriteText(folder + "/levels.csv",
              CsvOf(result["levels"]["luminaires"], {{"id", "/id"},
                                                     {"dimming", "/dimming"},
                                                     {"power_w", "/power_w"},
                                                     {"power_full_w", "/power_full_w"}}));
    WriteText(folder + "/targets.csv", CsvOf(result["levels"]["targets"], {{"target", "/name"},
                                                                           {"needed_lx", "/needed_lx"},
                                                                           {"reached_lx", "/reached_lx"},
                                                                           {"assured95_lx", "/assured95_lx"},
                                                                           {"full_on_lx", "/full_on_lx"},
                                                                           {"lacks_lx", "/lacks_lx"}}));
  }
  WriteJson(folder + "/commission.json", result);
  std::fputs(options.json ? JsonText(result).c_str() : text.c_str(), stdout);
  std::fprintf(stderr, "done      %s\n", (folder + "/commission.json").c_str());
  return is_reached ? 0 : 1;
}

}  // namespace luxfit
