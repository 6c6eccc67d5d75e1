#include "apps/commands/internal/room_run.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/charts/plan_svg.h"
#include "apps/commands/internal/run_plan.h"
#include "apps/export/fitted_room.h"
#include "apps/export/luminaire_files.h"
#include "apps/report/report.h"
#include "apps/session/earlier_result.h"
#include "apps/stages/albedo/stage_albedo.h"
#include "apps/stages/check/applied_explanations.h"
#include "apps/stages/fit_stop.h"
#include "apps/stages/prepared_session.h"
#include "apps/stages/session_light.h"
#include "apps/stages/stage_cache.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/text_file.h"
#include "apps/text/terminal.h"

namespace luxfit {
namespace {

using nlohmann::json;

// Adds the run's own files to the inputs of its result, so that a file that was changed or removed is made
// again.
StageInputs WithOutputs(StageInputs inputs, const std::string& out) {
  for (const char* name : {"result.json", "plan.svg"}) {
    const std::string path = out + "/" + name;
    inputs[name] = std::filesystem::exists(path) ? HashFile(path) : "";
  }
  return inputs;
}

int Show(const json& result, const RunCommandOptions& options, RoomRun what) {
  const std::string text =
      options.json ? JsonText(result)
                   : (what == RoomRun::kFitAndAlbedo ? AlbedoTable(result) : ResultTables(result));
  if (options.prints) PrintText(text);
  return result.at("status") == "done" ? 0 : 1;
}

struct RoomResult {
  json result;
  std::string plan_svg;
  RegisteredSession registered;
  Room room;
};

struct FittedSession {
  PreparedSession prepared;
  Session session;  // with as many luminaires as were counted
  RoomFit fit;
};

FittedSession FitOf(PreparedSession prepared, RunContext& context) {
  const Evidence& observed = prepared.observed;
  const LinearizedSession& linearized = prepared.linearized;
  Session session = WithCountedLuminaires(prepared.session, linearized, prepared.room, observed, context);
  RoomFit fit = FitSession(session, linearized, prepared.room, observed, context);
  // The fit may do with fewer than were counted.
  if (session.count_is_estimated)
    session = WithMoreLuminaires(prepared.session, static_cast<int>(fit.fit.state.luminaires.size()));
  return {std::move(prepared), std::move(session), std::move(fit)};
}

// Fits the session, and once more with each explanation that is taken. Findings of a fit that is done again do not count.
FittedSession FitExplained(const Session& read, const SessionInputs& inputs, const RunCommandOptions& options,
                           AppliedExplanations& applied, RunContext& context) {
  while (true) {
    RunContext own = context;
    own.Add(applied.findings);
    const auto keep_times = [&] {
      std::fprintf(stderr, "apply     %s\n", applied.findings.warnings.back().message.c_str());
      context.timing_s = own.timing_s;
      context.stop = own.stop;
    };
    PreparedSession prepared = PrepareSession(Corrected(read, applied.corrections),
                                              WithCorrections(inputs, applied.corrections), own);
    if (options.applies && TakeFromPhotos(prepared, applied)) {
      keep_times();
      continue;
    }
    if (!own.stop) own.stop = std::make_shared<FitStop>(options.budget_s);
    FittedSession fitted = FitOf(std::move(prepared), own);
    if (options.applies && TakeFromReadings(fitted.prepared, fitted.session, fitted.fit, applied)) {
      keep_times();
      continue;
    }
    own.stop.reset();
    context = std::move(own);
    return fitted;
  }
}

RoomResult FitAndDescribe(const Session& read, const SessionInputs& inputs, RoomRun what,
                          const RunCommandOptions& options, RunContext& context) {
  const StageTimer total(context, "total", "");
  AppliedExplanations applied;
  FittedSession fitted = FitExplained(read, inputs, options, applied, context);
  PreparedSession& prepared = fitted.prepared;
  const Evidence& observed = prepared.observed;
  const LinearizedSession& linearized = prepared.linearized;
  const Session& session = fitted.session;
  const RoomFit& fit = fitted.fit;
  const std::vector<LuminaireFiles> files = WriteLuminaireFiles(session, fit, context);
  json result = ResultJson(session, linearized.readings, prepared.room, prepared.registered, observed, fit,
                           files, context);
  if (!applied.corrections.IsEmpty()) result["corrections"] = CorrectionsJson(applied.corrections);
  if (what == RoomRun::kFitAndAlbedo) {
    const json albedo = AlbedoOfRoom(session, prepared.room, fit, result, context);
    result = WithAlbedo(std::move(result), albedo, context);
  }
  std::string plan_svg = PlanSvg(session, prepared.room.scene, result);
  return {std::move(result), std::move(plan_svg), std::move(prepared.registered), std::move(prepared.room)};
}

// Returns the times of the stages of the last run into a folder; nothing where there was none.
std::map<std::string, double> LastTimes(const std::string& out) {
  std::map<std::string, double> times_s;
  try {
    const json result = ReadResult(out + "/result.json");
    for (const auto& [stage, time_s] : result.at("timing_s").items()) times_s[stage] = time_s.get<double>();
  } catch (const std::exception&) {
    times_s.clear();  // a first run, or a folder with other contents
  }
  return times_s;
}

bool HasFlux(const json& luminaire) {
  return luminaire.at("flux_lm").is_number() || luminaire.contains("flux_relative");
}

// Takes the session file as it is now into the inputs of a result that stands: its comments or [report], on which no
// stage depends, may differ, and the report expects the file of the result. Returns whether it differs.
bool TakeSessionFile(const std::string& session_path, json& result) {
  const std::string hash = HashFile(session_path);
  json& known = result.at("inputs")[session_path];
  if (known == hash) return false;
  known = hash;
  return true;
}

// Writes the report page. Returns the seconds that it took.
double MakeReport(const RunContext& context, const std::function<FittedRoom()>& fitted_room) {
  RunContext own;
  own.expected_s = context.expected_s;
  {
    const StageTimer timer(own, "report", context.out + "/report.html");
    const FittedRoom fitted = fitted_room();
    WriteReport(fitted, ReportData(fitted, {"", "", context.provenance.command_line}));
  }
  return own.timing_s.at("report");
}

}  // namespace

RunContext MakeContext(const SessionCommandOptions& options, const Session& session) {
  RunContext context;
  context.out = std::filesystem::absolute(options.out).lexically_normal().string();
  ExpectUtf8Path(session.path);
  ExpectUtf8Path(context.out);
  ExpectOwnFolders(context.out);
  context.provenance = {options.command_line, session.input_files};
  context.expected_s = LastTimes(context.out);
  return context;
}

int RunRoom(Session session, const RunCommandOptions& options, RoomRun what) {
  SessionInputs inputs = InputsOfStages(session, options.earlier_luminaires);
  inputs.result["what is asked for"] = what == RoomRun::kFitAndAlbedo ? "albedo" : "fit";
  if (options.applies) inputs.result["--apply"] = "yes";
  RunContext context = MakeContext(options, session);
  const std::string path = context.out + "/result.json";
  const RunPlan plan = PlanOf(inputs, WithOutputs(inputs.result, context.out), context.out);
  if (options.dry_run) {
    PrintText(options.json ? JsonText(PlanJson(plan)) : PlanText(plan));
    return 0;
  }
  // A fit without luminaires, or with some of unknown flux, has no report, and its warnings say why.
  const auto has_report = [&](const json& result) {
    const json& luminaires = result.at("luminaires");
    return what == RoomRun::kAll && !luminaires.empty() &&
           std::all_of(luminaires.begin(), luminaires.end(), HasFlux);
  };
  if (plan.is_up_to_date && !options.fresh) {
    std::fprintf(stderr, "done      nothing has changed since the last run: its result stands, %s\n",
                 path.c_str());
    json result = ReadResult(path);
    const bool is_said_anew = TakeSessionFile(session.path, result);
    if (is_said_anew) {
      WriteJson(path, result);
      KeepInputs(context.out, "result", WithOutputs(inputs.result, context.out));
    }
    if (has_report(result) && (is_said_anew || !std::filesystem::exists(context.out + "/report.html")))
      MakeReport(context, [&] { return ReadFittedRoom(context.out); });
    return Show(result, options, what);
  }
  if (options.fresh) std::filesystem::remove_all(context.out + "/stages");
  if (!options.earlier_luminaires.empty())
    session = WithLuminairesOf(std::move(session), options.earlier_luminaires);
  RoomResult made = FitAndDescribe(session, inputs, what, options, context);
  made.result["timing_s"] = context.timing_s;
  made.result["reused_stages"] = context.reused_stages;
  if (!made.plan_svg.empty()) WriteText(context.out + "/plan.svg", made.plan_svg);
  WriteJson(path, made.result);
  double report_s = 0;
  if (has_report(made.result)) {
    report_s = MakeReport(
        context, [&] { return FittedRoomOf(context.out, std::move(made.registered), std::move(made.room)); });
  }
  // The next run takes up what was stopped.
  if (!made.result.contains("stopped"))
    KeepInputs(context.out, "result", WithOutputs(inputs.result, context.out));
  const int status = Show(made.result, options, what);
  std::fprintf(stderr, "done      %.1f s, %s\n", context.timing_s["total"] + report_s,
               report_s > 0 ? (context.out + "/report.html").c_str() : path.c_str());
  return status;
}

}  // namespace luxfit
