#include "apps/stages/check/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/text/formats/json_vectors.h"
#include "apps/text/name_pattern.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using nlohmann::json;

bool Matches(const NamedReading& reading, const std::string& pattern) {
  const size_t at = pattern.find('@');
  return MatchesPattern(reading.id, pattern.substr(0, at)) &&
         (at == std::string::npos || MatchesPattern(reading.state, pattern.substr(at + 1)));
}

template <typename Belongs>
json Row(const std::string& of, const std::vector<NamedReading>& readings, const Belongs& belongs) {
  std::vector<CheckedReading> own;
  double measured_lx = 0, difference_lx = 0;
  for (const NamedReading& named : readings) {
    if (!belongs(named)) continue;
    own.push_back(named.reading);
    measured_lx += named.reading.measured_lx;
    difference_lx += named.reading.predicted_lx - named.reading.measured_lx;
  }
  const LuxmeterSummary summary = SummarizeLuxmeter(own);
  const double mean_percent = measured_lx > 0 ? 100 * difference_lx / measured_lx : 0;
  return {{"of", of},
          {"readings", summary.readings_checked},
          {"mean_lx", NumberOrNull(measured_lx / static_cast<double>(own.size()))},
          {"mean_error_percent", own.empty() ? json() : json(mean_percent)},
          {"mean_abs_error_lx", NumberOrNull(summary.mean_abs_error_lx)},
          {"mean_abs_error_percent", NumberOrNull(summary.mean_abs_error_percent)},
          {"max_abs_error_percent", NumberOrNull(summary.max_abs_error_percent)}};
}

json TableOf(const std::vector<NamedReading>& readings, const std::string& subset) {
  std::vector<std::string> ids;
  for (const NamedReading& named : readings) {
    if (std::find(ids.begin(), ids.end(), named.id) == ids.end()) ids.push_back(named.id);
  }
  json table = json::array();
  for (const std::string& id : ids)
    table.push_back(Row(id, readings, [&](const NamedReading& r) { return r.id == id; }));
  table.push_back(Row("all", readings, [](const NamedReading&) { return true; }));
  if (subset.empty()) return table;
  table.push_back(Row(subset, readings, [&](const NamedReading& r) { return Matches(r, subset); }));
  if (table.back()["readings"] == 0)
    throw std::runtime_error("--subset: expected a pattern that matches a reading that checks, got " +
                             Quoted(subset) + "; a pattern is id or id@state, with * for any text");
  return table;
}

std::string WithRemedy(const json& finding) {
  return fmt::format("{}\n         remedy: {}\n", finding["message"].get<std::string>(),
                     finding["remedy"].get<std::string>());
}

}  // namespace

std::vector<NamedReading> CheckedReadings(const json& luxmeter) {
  std::vector<NamedReading> readings;
  for (const json& entry : luxmeter) {
    const bool both = entry["measured_lx"].is_number() && entry["predicted_lx"].is_number();
    if (!both || entry["role"] != "check") continue;
    NamedReading named{entry["id"].get<std::string>(), entry["state"].get<std::string>(), {}};
    named.reading.measured_lx = entry["measured_lx"].get<double>();
    named.reading.predicted_lx = entry["predicted_lx"].get<double>();
    named.reading.measured_sigma_lx = entry.value("measured_sigma_lx", 0.0);
    // Results that do not hold the model error give the prediction's own sigma alone.
    named.reading.predicted_sigma_lx = entry.value("prediction_sigma_lx", entry.value("sigma_lx", 0.0));
    const auto direct = entry.find("direct_by_luminaire_lx");
    if (direct != entry.end()) {
      for (const auto& [luminaire, lx] : direct->items())
        named.direct_lx.emplace_back(luminaire, lx.get<double>());
    }
    readings.push_back(std::move(named));
  }
  return readings;
}

json SummaryJson(const LuxmeterSummary& summary) {
  return {{"mean_abs_error_lx", NumberOrNull(summary.mean_abs_error_lx)},
          {"mean_abs_error_percent", NumberOrNull(summary.mean_abs_error_percent)},
          {"max_abs_error_percent", NumberOrNull(summary.max_abs_error_percent)},
          {"readings_checked", summary.readings_checked}};
}

json CheckJson(const json& luxmeter, const std::string& subset) {
  const std::vector<NamedReading> readings = CheckedReadings(luxmeter);
  const LuxmeterFindings findings = FindDisagreements(readings);
  json check;
  check["table"] = TableOf(readings, subset);
  check["z_limit"] = findings.z_limit;
  check["common"] = {{"factor", findings.common_factor},
                     {"sigma", findings.common_sigma},
                     {"beyond_chance", findings.has_common_factor}};
  if (findings.has_common_factor) {
    check["common"]["message"] = findings.common_meaning;
    check["common"]["remedy"] = findings.common_remedy;
  }
  check["disagreements"] = json::array();
  for (const Disagreement& d : findings.disagreements) {
    check["disagreements"].push_back(
        {{"id", d.id}, {"state", d.state}, {"z", d.z}, {"message", d.meaning}, {"remedy", d.remedy}});
  }
  return check;
}

std::string CheckText(const json& check) {
  // Hundreds of ids would hide the rest; result.json has them all.
  constexpr size_t kMaxRows = 64;
  const json& table = check["table"];
  std::string explained = check.contains("explained") ? WithRemedy(check["explained"]) : "";
  if (table.empty() || table[0]["readings"] == 0) return explained;
  std::string text =
      "\nof           readings  mean lx   mean error %   mean |error| lx   % of mean   largest %\n";
  const size_t first = table.size() > kMaxRows ? table.size() - 2 : 0;
  for (size_t i = first; i < table.size(); ++i) {
    const json& row = table[i];
    text +=
        fmt::format("{:<12} {:>8} {:>8.1f} {:>14} {:>17.2f} {:>11.2f} {:>11.2f}\n",
                    row["of"].get<std::string>(), row["readings"].get<int>(), row["mean_lx"].get<double>(),
                    fmt::format("{:+.2f}", row["mean_error_percent"].get<double>()),
                    row["mean_abs_error_lx"].get<double>(), row["mean_abs_error_percent"].get<double>(),
                    row["max_abs_error_percent"].get<double>());
  }
  text += explained;
  const json& common = check["common"];
  text += fmt::format("measured / predicted in common: {:.4f} ± {:.4f}{}\n", common["factor"].get<double>(),
                      common["sigma"].get<double>(),
                      common["beyond_chance"].get<bool>() ? "" : ", no more than chance");
  if (common["beyond_chance"].get<bool>()) text += WithRemedy(common);
  for (const json& d : check["disagreements"])
    text += fmt::format("{} (z = {:.1f})\n         remedy: {}\n", d["message"].get<std::string>(),
                        d["z"].get<double>(), d["remedy"].get<std::string>());
  if (check["disagreements"].empty())
    text += fmt::format("no reading disagrees: |z| stays below {:.2f}, the limit for so many readings\n",
                        check["z_limit"].get<double>());
  return text;
}

}  // namespace luxfit
