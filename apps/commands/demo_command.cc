#include "apps/commands/demo_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/commands/commands.h"
#include "apps/session/earlier_result.h"
#include "apps/stages/prepared_session.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/terminal.h"
#include "inverse/study/stability_score.h"

namespace luxfit {
namespace {

namespace fs = std::filesystem;

std::string FolderOf(const std::string& room) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path installed = program.parent_path().parent_path() / "share/luxfit" / room,
                 source = fs::path(LUXFIT_ROOMS) / room;
  for (const fs::path& folder : {installed, source}) {
    if (fs::exists(folder / "session.toml")) return folder.string();
  }
  throw std::runtime_error("demo: expected the photos of " + room + " in " + installed.string() + " or " +
                           source.string() + ", found none; install luxfit again, or run it on fixtures/" +
                           room + " of the source");
}

std::vector<EstimatedLuminaire> FoundIn(const nlohmann::json& result) {
  std::vector<EstimatedLuminaire> found;
  for (const nlohmann::json& entry : result.at("luminaires")) {
    EstimatedLuminaire luminaire;
    luminaire.id = entry.at("id");
    luminaire.position = VectorFromJson(entry.at("position_m"));
    luminaire.flux = entry.at("flux_lm");
    found.push_back(luminaire);
  }
  return found;
}

std::string TruthText(const nlohmann::json& result, const std::string& truth_path) {
  const FitScore score = ScoreFit(FoundIn(result), ReadTruth(truth_path), false);
  return fmt::format(
      "\nThis is a rendered room whose truth is known: luminaires are off by {:.1f} mm, {:.1f} at "
      "most, fluxes by "
      "{:.2f} %, {:.2f} at most.\n",
      1e3 * score.position_error_m, 1e3 * score.worst_position_m, 100 * score.flux_error,
      100 * score.worst_flux);
}

}  // namespace

const std::vector<std::string>& DemoRooms() {
  static const std::vector<std::string> kRooms = {"office", "openplan"};
  return kRooms;
}

int DemoCommand(const DemoCommandOptions& options) {
  const std::string folder = FolderOf(options.room);
  RunCommandOptions run;
  run.session = folder + "/session.toml";
  run.out = options.out;
  run.command_line = options.command_line;
  run.json = options.json;
  const int status = RunCommand(run);
  if (!options.json) PrintText(TruthText(ReadResult(options.out + "/result.json"), folder + "/truth.json"));
  return status;
}

}  // namespace luxfit
