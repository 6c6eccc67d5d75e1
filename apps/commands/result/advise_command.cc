#include "apps/commands/result/advise_command.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "apps/charts/plan_svg.h"
#include "apps/commands/internal/advise/advice_given.h"
#include "apps/commands/internal/advise/advice_guess.h"
#include "apps/commands/internal/advise/advice_words.h"
#include "apps/session/earlier_result.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr int kTopOfRun = 5, kTopOfSession = 12;

std::string AbsoluteFolderOf(const std::string& folder) {
  return std::filesystem::absolute(folder).lexically_normal().string();
}

// Returns what is asked for; `of` is a kind, the id of a luminaire, or empty.
AdviceOptions AskedFor(const std::string& of, const std::vector<Luminaire>& luminaires) {
  AdviceOptions asked;
  if (of.empty()) return asked;
  if (of == "flux" || of == "position" || of == "readings") {
    asked.kinds = {of == "flux" ? AdviceKind::kFlux
                                : (of == "position" ? AdviceKind::kPosition : AdviceKind::kReading)};
    return asked;
  }
  std::vector<std::string> known{"flux", "position", "readings"};
  for (const Luminaire& luminaire : luminaires) known.push_back(luminaire.id);
  if (std::count(known.begin(), known.end(), of) == 0)
    throw std::runtime_error("--of: " + ExpectedOneOf(known, of));
  asked.owner = of;
  return asked;
}

void ExpectDerivatives(const FittedRoom& fitted) {
  if (fitted.room.sparse)
    throw std::runtime_error(fitted.session.path +
                             ": scene: expected a room of which light has derivatives, got one of too many "
                             "patches; leave out small furniture");
}

// Returns whether something asked for stays undetermined, whatever is taken.
bool StaysUndetermined(const AdvicePlan& plan) { return plan.is_enough && !plan.Undetermined().empty(); }

AdviceCandidates CandidatesOf(const AdviseCommandOptions& options) {
  return {options.only != "readings", options.only != "photos", options.photo_table, options.reading_table};
}

// Where the advice is for, and what is drawn beside it.
struct AdviceScene {
  std::string name;
  const Room& room;
  json result;      // views and luminaires
  std::string out;  // folder to write into; empty: none
  Provenance provenance;
};

int Give(const AdviseCommandOptions& options, const SessionAdvice& advice, int count, AdviceScene scene) {
  AdviceOptions asked = AskedFor(options.of, advice.given.luminaires);
  asked.count = count;
  const AdvicePlan plan = Advise(scene.room, advice.given, asked);
  for (const std::string& table : {options.photo_table, options.reading_table}) {
    if (!table.empty())
      scene.provenance.inputs.push_back(std::filesystem::absolute(table).lexically_normal().string());
  }
  json artifact = ProvenanceJson("luxfit-advise-1", scene.provenance);
  artifact["of"] = options.of.empty() ? "flux and position" : options.of;
  artifact["candidates"] = {{"photos", advice.given.photos.size()},
                            {"readings", advice.given.readings.size()}};
  AddAdvice(scene.room, advice, plan, asked.least_gain, artifact);
  const std::string beside = scene.out.empty() ? "" : scene.out + "/advise.svg";
  const std::string picture = options.plan.empty() ? beside : options.plan;
  const std::string svg = AdvicePlanSvg(scene.name, scene.room.scene, scene.result, artifact);
  if (!svg.empty() && !picture.empty()) WriteText(picture, svg);
  if (!scene.out.empty()) WriteJson(scene.out + "/advise.json", artifact);
  std::fputs(options.json ? JsonText(artifact).c_str() : AdviceText(artifact).c_str(), stdout);
  if (!scene.out.empty()) std::fprintf(stderr, "done      %s\n", (scene.out + "/advise.json").c_str());
  return StaysUndetermined(plan) ? 1 : 0;
}

int AdviseAfterRun(const AdviseCommandOptions& options) {
  const FittedRoom fitted = ReadFittedRoom(RunFolderOf(options.input), options.session, FluxUnit::kAsFitted);
  const std::string out = options.out.empty() ? fitted.out : AbsoluteFolderOf(options.out);
  ExpectOwnFolders(out);
  ExpectDerivatives(fitted);
  return Give(options, SessionAdviceOf(fitted, CandidatesOf(options)),
              options.top > 0 ? options.top : kTopOfRun,
              {fitted.session.name,
               fitted.room,
               *fitted.result,
               out,
               {options.command_line, {fitted.out + "/result.json", fitted.out + "/stages/fit.json"}}});
}

// Returns luminaires as a result has them, without fluxes.
json LuminairesToDraw(const std::vector<Luminaire>& luminaires) {
  json drawn = json::array();
  for (const Luminaire& luminaire : luminaires) {
    json size = json::array();
    if (luminaire.shape != LuminaireShape::kPoint) size = {luminaire.size_m[0], luminaire.size_m[1]};
    drawn.push_back({{"id", luminaire.id},
                     {"position_m", VectorJson(luminaire.position)},
                     {"shape", ToString(luminaire.shape)},
                     {"size_m", size}});
  }
  return drawn;
}

int AdviseBeforeRun(const AdviseCommandOptions& options, const std::string& session_file) {
  if (!options.session.empty())
    throw std::runtime_error("--session: expected a run before it, got the session " + session_file +
                             "; leave out --session");
  const GuessedSession guessed = GuessSession(session_file, CandidatesOf(options));
  const Session& session = guessed.session;
  if (!session.photos.empty())
    std::fprintf(stderr,
                 "note      the session has photos, which do not count here; after `luxfit run`, "
                 "`luxfit advise OUT` counts them\n");
  const std::string out = options.out.empty() ? "" : AbsoluteFolderOf(options.out);
  if (!out.empty()) ExpectOwnFolders(out);
  std::vector<std::string> inputs{session.path};
  for (const std::string& file : {session.scene->mesh, session.tags.map_path}) {
    if (!file.empty()) inputs.push_back(file);
  }
  return Give(options, guessed.advice, options.top > 0 ? options.top : kTopOfSession,
              {session.name,
               guessed.room,
               {{"views", json::array()}, {"luminaires", LuminairesToDraw(guessed.advice.given.luminaires)}},
               out,
               {options.command_line, inputs}});
}

// Returns the session file that the input names, itself or by its folder; empty: the input is a run.
std::string SessionFileOf(const std::string& input) {
  namespace fs = std::filesystem;
  const fs::path path = input;
  if (path.extension() == ".toml") return input;
  const bool is_session =
      fs::is_directory(path) && !fs::exists(path / "result.json") && fs::exists(path / "session.toml");
  return is_session ? (path / "session.toml").string() : "";
}

}  // namespace

int AdviseCommand(const AdviseCommandOptions& options) {
  const std::string session_file = SessionFileOf(options.input);
  return session_file.empty() ? AdviseAfterRun(options) : AdviseBeforeRun(options, session_file);
}

}  // namespace luxfit
