#include "apps/commands/result/report_command.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/report/calibration/calibration_report.h"
#include "apps/report/report.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/input_error.h"

namespace luxfit {
namespace {

using nlohmann::json;

std::string PlusMinusInUnit(const json& value, const json& sigma, const char* unit) {
  const std::string number = fmt::format("{:.4g}", value.get<double>());
  if (!sigma.is_number()) return number + unit + " (uncertainty not determined)";
  return number + fmt::format(" ± {:.2g}{}", 1.96 * sigma.get<double>(), unit);
}

std::string SummaryText(const json& summary) {
  std::string text;
  const json& states = summary.at("states");
  const char* unit = summary.at("is_absolute") ? " lx" : " (relative)";
  for (const json& area : summary.at("areas")) {
    for (size_t s = 0; s < states.size(); ++s) {
      const json& statistics = area.at("statistics").at(s);
      if (states[s] != summary.at("state")) continue;
      text +=
          fmt::format("{}, state {}: {} points, mean {}, least {}, U0 {}\n", area.at("id").get<std::string>(),
                      states[s].get<std::string>(), statistics.at("points").get<int>(),
                      PlusMinusInUnit(statistics.at("average_lx"), statistics.at("average_sigma_lx"), unit),
                      PlusMinusInUnit(statistics.at("least_lx"), statistics.at("least_sigma_lx"), unit),
                      PlusMinusInUnit(statistics.at("uniformity"), statistics.at("uniformity_sigma"), ""));
    }
  }
  return text;
}

// Holds what a page says in figures, and the text for the terminal.
struct Reported {
  json summary;
  std::string text;
};

Reported ReportRoom(const ReportCommandOptions& options) {
  const FittedRoom fitted = ReadFittedRoom(options.out, options.session);
  const json data = ReportData(fitted, {options.targets, options.state, options.command_line});
  json summary = ReportSummary(data);
  summary["report"] = WriteReport(fitted, data);
  std::string text = SummaryText(summary);
  return {std::move(summary), std::move(text)};
}

Reported ReportCalibration(const ReportCommandOptions& options) {
  const std::string file = CalibrationFileOf(options.out);
  for (const auto& [flag, value] : {std::pair{"--session", options.session},
                                    {"--targets", options.targets},
                                    {"--state", options.state}}) {
    if (!value.empty())
      throw InputError(
          {flag, 0}, "",
          "expected the result of a room, got the calibration " + file + "; leave " + flag + " out");
  }
  const CalibrationRecord record = ReadCalibrationRecord(options.out);
  const std::string path = record.out + "/report.html";
  WriteText(path, CalibrationPage(record, options.command_line));
  json summary = CalibrationSummary(record);
  summary["report"] = path;
  std::string text = summary.at("verdict").get<std::string>() + "\n";
  return {std::move(summary), std::move(text)};
}

Reported Report(const ReportCommandOptions& options) {
  namespace fs = std::filesystem;
  if (fs::exists(options.out + "/result.json")) return ReportRoom(options);
  if (fs::exists(CalibrationFileOf(options.out))) return ReportCalibration(options);
  throw InputError(
      {options.out + "/result.json", 0}, "",
      "expected the result of a room, or stages/calibrate.json of cameras beside it, got neither; run "
      "`luxfit run` or `luxfit calibrate` with -o " +
          options.out);
}

}  // namespace

int ReportCommand(const ReportCommandOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Reported reported = Report(options);
  const auto path = reported.summary.at("report").get<std::string>();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::fputs((options.json ? JsonText(reported.summary) : reported.text).c_str(), stdout);
  std::fprintf(stderr, "done      %.1f s, %s, %.1f MB\n", elapsed.count(), path.c_str(),
               1e-6 * static_cast<double>(std::filesystem::file_size(path)));
  return 0;
}

}  // namespace luxfit
