#include "apps/commands/result/advise_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "apps/charts/plan_svg.h"
#include "apps/commands/internal/advice_given.h"
#include "apps/commands/internal/advice_words.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using nlohmann::json;

// Returns what is asked for; `of` is a kind, the id of a luminaire, or empty.
AdviceOptions AskedFor(const std::string& of, const FittedRoom& fitted) {
  AdviceOptions asked;
  if (of.empty()) return asked;
  if (of == "flux" || of == "position" || of == "readings") {
    asked.kinds = {of == "flux" ? AdviceKind::kFlux
                                : (of == "position" ? AdviceKind::kPosition : AdviceKind::kReading)};
    return asked;
  }
  std::vector<std::string> known{"flux", "position", "readings"};
  for (const Luminaire& luminaire : fitted.luminaires) known.push_back(luminaire.id);
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

// Returns whether everything asked for is determined in the end.
bool IsAllDetermined(const AdvicePlan& plan) {
  const std::vector<SigmaChange>& last = plan.steps.empty() ? plan.now : plan.steps.back().changes;
  return std::all_of(last.begin(), last.end(),
                     [](const SigmaChange& change) { return change.is_determined; });
}

}  // namespace

int AdviseCommand(const AdviseCommandOptions& options) {
  const FittedRoom fitted = ReadFittedRoom(options.out, options.session, FluxUnit::kAsFitted);
  ExpectOwnFolders(fitted.out);
  ExpectDerivatives(fitted);
  AdviceOptions asked = AskedFor(options.of, fitted);
  asked.count = options.top;
  const SessionAdvice advice = SessionAdviceOf(fitted, {options.only != "readings", options.only != "photos",
                                                        options.photo_table, options.reading_table});
  const AdvicePlan plan = Advise(fitted.room, advice.given, asked);
  Provenance provenance{options.command_line, {fitted.out + "/result.json", fitted.out + "/stages/fit.json"}};
  for (const std::string& table : {options.photo_table, options.reading_table}) {
    if (!table.empty())
      provenance.inputs.push_back(std::filesystem::absolute(table).lexically_normal().string());
  }
  json artifact = ProvenanceJson("luxfit-advise-1", provenance);
  artifact["of"] = options.of.empty() ? "flux and position" : options.of;
  artifact["candidates"] = {{"photos", advice.given.photos.size()},
                            {"readings", advice.given.readings.size()}};
  AddAdvice(fitted.room, advice, plan, asked.least_gain, artifact);
  const std::string picture = options.plan.empty() ? fitted.out + "/advise.svg" : options.plan;
  const std::string svg = AdvicePlanSvg(fitted.session.name, fitted.room.scene, *fitted.result, artifact);
  if (!svg.empty()) WriteText(picture, svg);
  WriteJson(fitted.out + "/advise.json", artifact);
  std::fputs(options.json ? JsonText(artifact).c_str() : AdviceText(artifact).c_str(), stdout);
  std::fprintf(stderr, "done      %s\n", (fitted.out + "/advise.json").c_str());
  return IsAllDetermined(plan) ? 0 : 1;
}

}  // namespace luxfit
