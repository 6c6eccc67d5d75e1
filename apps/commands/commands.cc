#include "apps/commands/commands.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "apps/commands/internal/photo_session.h"
#include "apps/commands/internal/room_run.h"
#include "apps/commands/internal/session_pictures.h"
#include "apps/session/earlier_result.h"
#include "apps/stages/albedo/stage_stereo.h"
#include "apps/stages/calibrate/calibration_table.h"
#include "apps/stages/calibrate/stage_calibrate.h"
#include "apps/stages/check/check_report.h"
#include "apps/stages/prepared_session.h"
#include "apps/stages/stages.h"
#include "apps/text/input_error.h"
#include "apps/text/terminal.h"

namespace luxfit {
namespace {

// Reads the session of a command that needs a room.
Session ReadRoomSession(const SessionCommandOptions& options) {
  Session session = ReadSession(options.session);
  if (session.lights)
    throw InputError({session.path, session.lights->line}, "lights",
                     "expected the session of a room, got one of an object; run luxfit albedo on it");
  return session;
}

// Reads the session of `luxfit calibrate`, or makes one of photos.
Session SessionToCalibrate(const CalibrateCommandOptions& options) {
  if (!IsSessionFile(options.inputs, options.board))
    return SessionOfPhotos(options.inputs, options.board, options.rig);
  if (!options.board.empty() || !options.rig.empty())
    throw std::runtime_error(
        fmt::format("{}: expected photos, got a session; write {} there, or name photos instead",
                    options.board.empty() ? "--rig" : "--board",
                    options.board.empty() ? "[calibration] rig" : "the camera's board"));
  SessionCommandOptions of_session = options;
  of_session.session = options.inputs.front();
  return ReadRoomSession(of_session);
}

// Charts the stability of a session's fit. Returns exit status 1 where the undegraded session has no fit.
int ChartStability(const ChartCommandOptions& options, const Session& session) {
  RunContext context = MakeContext(options, session);
  StabilityOptions stability = options.stability_options;
  stability.before = options.before;
  const nlohmann::json artifact = StabilityOfSession(session, stability, context);
  PrintText(options.json ? JsonText(artifact) : StabilityTable(artifact));
  std::fprintf(stderr, "done      %s\n", (context.out + "/stability.csv").c_str());
  return context.IsUndetermined() ? 1 : 0;
}

int ChartWholeFit(const ChartCommandOptions& options, const Session& session) {
  RunContext context = MakeContext(options, session);
  const nlohmann::json artifact = FitChartOfSession(
      session, {options.stability_options.elements, options.stability_options.truth_path, options.before},
      context);
  PrintText(options.json ? JsonText(artifact) : FitChartTable(artifact));
  std::fprintf(stderr, "done      %s\n", (context.out + "/fit.csv").c_str());
  return 0;
}

}  // namespace

int RunCommand(const RunCommandOptions& options) {
  return RunRoom(ReadRoomSession(options), options, RoomRun::kAll);
}

int FitCommand(const RunCommandOptions& options) {
  return RunRoom(ReadRoomSession(options), options, RoomRun::kFit);
}

int AlbedoCommand(const AlbedoCommandOptions& options) {
  Session session = ReadSession(options.session);
  if (!session.lights) {
    if (session.photos.empty())
      throw std::runtime_error(options.session + ": photos: expected photos, got none; add [photos]");
    return RunRoom(std::move(session), {options, options.dry_run, options.fresh, "", true, options.budget_s},
                   RoomRun::kFitAndAlbedo);
  }
  RunContext context = MakeContext(options, session);
  nlohmann::json result;
  {
    const StageTimer total(context, "total", "");
    const LinearizedSession linearized = LinearizeSession(session, context);
    result = StereoResultJson(session, StereoSession(session, linearized.photos, context), context);
  }
  result["timing_s"] = context.timing_s;
  WriteJson(context.out + "/result.json", result);
  PrintText(options.json ? JsonText(result) : StereoTable(result));
  std::fprintf(stderr, "done      %.1f s, %s\n", context.timing_s["total"],
               (context.out + "/result.json").c_str());
  return context.IsUndetermined() ? 1 : 0;
}

int SimulateCommand(const SimulateCommandOptions& options) {
  const Session session = ReadRoomSession(options);
  RunContext context = MakeContext(options, session);
  const nlohmann::json artifact = SimulateSession(session, options.error_percent, context);
  PrintText(options.json ? JsonText(artifact) : SimulationTable(artifact));
  std::fprintf(stderr, "done      %s\n", (context.out + "/illuminance.csv").c_str());
  return context.IsUndetermined() ? 1 : 0;
}

int ChartCommand(const ChartCommandOptions& options) {
  Session session = ReadRoomSession(options);
  if (options.stability) return ChartStability(options, session);
  if (options.whole_fit) return ChartWholeFit(options, session);
  if (!options.earlier_result.empty()) session = WithResult(std::move(session), options.earlier_result);
  RunContext context = MakeContext(options, session);
  const nlohmann::json artifact = ChartSession(
      session, {options.error_percent, options.budget_s, options.threads, options.before}, context);
  PrintText(options.json ? JsonText(artifact) : ChartTable(artifact));
  std::fprintf(stderr, "done      %s\n", (context.out + "/chart.svg").c_str());
  return 0;
}

int LinearizeCommand(const LinearizeCommandOptions& options) {
  const Session session = ReadSession(options.session);
  RunContext context = MakeContext(options, session);
  if (session.photos.empty())
    throw std::runtime_error(options.session + ": photos: expected photos, got none; add [photos]");
  const LinearizedPhotos photos = LinearizeSession(session, context).photos;
  nlohmann::json artifact = ReadJson(context.out + "/stages/linearize.json");
  if (options.writes_pictures) {
    artifact["pictures"] = WriteSessionPictures(session, photos, context);
    artifact["warnings"] = WarningsJson(context);
    artifact["choices"] = ChoicesJson(context);
    WriteJson(context.out + "/stages/linearize.json", artifact);
  }
  PrintText(options.json ? JsonText(artifact) : LinearizeTable(session, artifact) + WarningText(artifact));
  return 0;
}

int CalibrateCommand(const CalibrateCommandOptions& options) {
  const Session session = SessionToCalibrate(options);
  RunContext context = MakeContext(options, session);
  const nlohmann::json artifact = CalibrateSession(session, context);
  PrintText(options.json ? JsonText(artifact) : CalibrationTable(artifact));
  std::fprintf(stderr, "done      %s\n", (context.out + "/stages/calibrate.json").c_str());
  return context.IsUndetermined() ? 1 : 0;
}

int RegisterCommand(const SessionCommandOptions& options) {
  const Session session = ReadRoomSession(options);
  RunContext context = MakeContext(options, session);
  LoadRoom(session, context);
  const SessionInputs inputs = InputsOfStages(session, "");
  const LinearizedSession linearized = LinearizeKept(session, inputs, context);
  RegisterKept(session, linearized.photos, inputs, context);
  nlohmann::json result = ReadJson(context.out + "/stages/register.json");
  if (options.json) {
    PrintText(JsonText(result));
    return context.IsUndetermined() ? 1 : 0;
  }
  result["warnings"] = WarningsJson(context);
  AddStatus(context, result);
  PrintText(RegistrationTable(result) + WarningText(result));
  return context.IsUndetermined() ? 1 : 0;
}

int CheckCommand(const CheckCommandOptions& options) {
  const nlohmann::json result = ReadResult(options.out + "/result.json");
  nlohmann::json check = CheckJson(result["luxmeter"], options.subset);
  // It rests on light at other places than those of the readings, which the run alone knew.
  if (result.contains("/check/explained"_json_pointer)) check["explained"] = result["check"]["explained"];
  if (options.json) {
    PrintText(JsonText({{"luxmeter", result["luxmeter"]}, {"summary", result["summary"]}, {"check", check}}));
  } else {
    PrintText(LuxmeterTable(result) + CheckText(check));
  }
  return result["status"] == "done" ? 0 : 1;
}

}  // namespace luxfit
