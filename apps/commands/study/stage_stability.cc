#include "apps/commands/study/stage_stability.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/commands/study/internal/earlier_chart.h"
#include "apps/commands/study/internal/stability_chart.h"
#include "apps/stages/degrade/degradations.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/formats/json_vectors.h"
#include "apps/text/trial_log.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr double kLeastSuccess = 0.9;

double NumberOf(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// Writes one line of the log.
json LineOf(const DegradedFit& fit) {
  const FitScore& s = fit.score;
  return {{"success", s.is_success},
          {"confident_wrong", s.is_confident_wrong},
          {"missing", s.missing},
          {"failed", fit.failed},
          {"undetermined", fit.failed || fit.refit.undetermined},
          {"message", fit.message},
          {"warnings", fit.new_warnings},
          {"position_error_m", NumberOrNull(s.position_error_m)},
          {"worst_position_m", NumberOrNull(s.worst_position_m)},
          {"flux_error", NumberOrNull(s.flux_error)},
          {"worst_flux", NumberOrNull(s.worst_flux)},
          {"intervals", s.intervals},
          {"intervals_held", s.intervals_held},
          {"lux_error_percent", NumberOrNull(fit.failed ? NAN : fit.refit.mean_lux_error_percent)},
          {"time_s", fit.seconds}};
}

FitScore ScoreOf(const json& line) {
  FitScore s;
  s.is_success = line.at("success");
  s.is_confident_wrong = line.at("confident_wrong");
  s.missing = line.at("missing");
  s.position_error_m = NumberOf(line.at("position_error_m"));
  s.flux_error = NumberOf(line.at("flux_error"));
  s.worst_position_m = NumberOf(line.at("worst_position_m"));
  s.worst_flux = NumberOf(line.at("worst_flux"));
  s.intervals = line.at("intervals");
  s.intervals_held = line.at("intervals_held");
  return s;
}

// Summarizes the lines of one level's trials.
LevelResult Summarize(double level, const std::vector<json>& lines) {
  LevelResult result;
  result.level = level;
  std::vector<FitScore> scores;
  std::vector<double> lux;
  for (const json& line : lines) {
    scores.push_back(ScoreOf(line));
    const bool undetermined = line.at("undetermined");
    result.undetermined += undetermined ? 1 : 0;
    result.warned += undetermined || !line.at("warnings").empty() ? 1 : 0;
    const double error = NumberOf(line.at("lux_error_percent"));
    if (std::isfinite(error)) lux.push_back(error);
  }
  result.summary = SummarizeTrials(scores);
  result.median_lux_error_percent = Median(lux);
  return result;
}

// Prints each trial with the remaining time, which follows from the trials of this call.
class Progress {
 public:
  Progress(size_t total, size_t done) : total_(total), done_(done) {}
  void Done(const std::string& trial, const json& line) {
    ++done_;
    seconds_ += line.at("time_s").get<double>();
    ++measured_;
    const double left_s = seconds_ / measured_ * static_cast<double>(total_ - done_);
    const bool success = line.at("success"), wrong = line.at("confident_wrong");
    std::fprintf(stderr, "stability %zu of %zu  %-40s %s  %.1f mm  %.2f %%  (%.0f s to go)\n", done_, total_,
                 trial.c_str(), success ? "good" : (wrong ? "WRONG AND SURE" : "not good"),
                 1e3 * NumberOf(line.at("worst_position_m")), 100 * NumberOf(line.at("worst_flux")), left_s);
  }

 private:
  size_t total_, done_;
  double seconds_ = 0;
  int measured_ = 0;
};

std::string TrialName(const Degradation& degradation, double level, int trial) {
  return fmt::format("{} {:g} {} #{}", degradation.name, level, degradation.unit, trial);
}

// Runs the trials that the log does not have yet.
std::vector<DegradationResult> RunTrials(DegradedSessions& sessions, const std::vector<Degradation>& asked,
                                         const StabilityOptions& options, TrialLog& log) {
  size_t total = 0, done = 0;
  for (const Degradation& d : asked) {
    total += d.levels.size() * static_cast<size_t>(options.trials);
    for (const double level : d.levels) {
      for (int trial = 0; trial < options.trials; ++trial)
        done += log.Find(TrialName(d, level, trial)) ? 1 : 0;
    }
  }
  if (done > 0) std::fprintf(stderr, "stability %zu of %zu trials were done earlier\n", done, total);
  Progress progress(total, done);
  std::vector<DegradationResult> results;
  for (const Degradation& d : asked) {
    DegradationResult result{d, {}};
    for (const double level : d.levels) {
      std::vector<json> lines;
      for (int trial = 0; trial < options.trials; ++trial) {
        const std::string name = TrialName(d, level, trial);
        if (!log.Find(name)) {
          log.Append(name, LineOf(sessions.Fit(d, level, trial)));
          progress.Done(name, *log.Find(name));
        }
        lines.push_back(*log.Find(name));
      }
      result.levels.push_back(Summarize(level, lines));
    }
    results.push_back(std::move(result));
  }
  return results;
}

json EdgeJson(const DegradationResult& result) {
  std::vector<LevelSummary> levels;
  for (const LevelResult& level : result.levels) levels.push_back(level.summary);
  const std::optional<size_t> bad = FirstBadLevel(levels, kLeastSuccess);
  json edge = {{"degradation", result.degradation.name},
               {"unit", result.degradation.unit},
               {"what", result.degradation.axis}};
  edge["first_bad_level"] = bad ? json(result.levels[*bad].level) : json();
  edge["last_good_level"] =
      !bad ? json(result.levels.back().level) : (*bad > 0 ? json(result.levels[*bad - 1].level) : json());
  int wrong = 0, trials = 0;
  for (const LevelSummary& level : levels) wrong += level.confident_wrong, trials += level.trials;
  edge["confident_wrong"] = wrong;
  edge["trials"] = trials;
  return edge;
}

// Identifies everything that a trial's line depends on.
std::string KeyOf(const StabilityOptions& options, const RunContext& context) {
  json made_from = ProvenanceJson("luxfit-stability-1", context.provenance);
  made_from.erase("command");
  made_from["seed"] = options.seed;
  made_from["elements"] = options.elements;
  return HashText(JsonText(made_from));
}

// Returns the rows of the earlier chart; none where none was named.
std::vector<StabilityRow> RowsBefore(const Session& session, const StabilityOptions& options,
                                     RunContext& context) {
  if (options.before.path.empty()) return {};
  const CsvTable table =
      ReadEarlierChart(options.before.path, {ChartKind::kStability, session.name, options.truth_path});
  context.provenance.inputs.push_back(table.path);
  return StabilityRowsOf(table);
}

json UndegradedJson(const DegradedSessions& sessions) {
  std::vector<std::string> codes;
  for (const Warning& warning : sessions.undegraded().warnings) codes.push_back(warning.code);
  return {{"success", sessions.undegraded_score().is_success},
          {"worst_position_m", NumberOrNull(sessions.undegraded_score().worst_position_m)},
          {"worst_flux", NumberOrNull(sessions.undegraded_score().worst_flux)},
          {"undetermined", sessions.undegraded().undetermined},
          {"warnings", codes}};
}

// Returns the artifact without its results.
json ArtifactOf(const Session& session, const StabilityOptions& options, const DegradedSessions& sessions,
                const RunContext& context) {
  json artifact = ProvenanceJson("luxfit-stability-1", context.provenance);
  artifact["session"] = session.name;
  artifact["seed"] = options.seed;
  artifact["trials"] = options.trials;
  artifact["elements"] = options.elements;
  artifact["reference"] = options.truth_path.empty() ? "the undegraded fit" : options.truth_path;
  artifact["simulated"] =
      "luminaires_together and albedo_raised are no photos: the fitted luminaires' light, traced in the "
      "session's mesh by an unbiased light tracer (no patches, no form factors, four points an element), "
      "with "
      "1 % of model error by facet and state";
  artifact["undegraded"] = UndegradedJson(sessions);
  artifact["skipped"] = json::array();
  artifact["edges"] = json::array();
  return artifact;
}

// Returns those that the session allows; `skipped` receives the others with the reason.
std::vector<Degradation> Allowed(const std::vector<Degradation>& asked, const DegradedSessions& sessions,
                                 json& skipped) {
  std::vector<Degradation> allowed;
  for (const Degradation& d : asked) {
    const std::optional<std::string> why = sessions.WhyNot(d);
    if (why) {
      skipped.push_back({{"degradation", d.name}, {"because", *why}});
    } else {
      allowed.push_back(d);
    }
  }
  return allowed;
}

void WritePictures(const std::vector<DegradationResult>& results, const std::vector<StabilityRow>& before,
                   const std::string& session, const StabilityOptions& options, const std::string& out) {
  for (const DegradationResult& result : results) {
    const StabilityPicture picture{session, options.trials, before, options.before.names};
    WriteText(out + "/stability_" + result.degradation.name + ".svg", StabilitySvg(result, picture));
  }
}

}  // namespace

json StabilityOfSession(const Session& session, const StabilityOptions& options, RunContext& context) {
  const std::vector<Degradation> asked = DegradationsNamed(options.only);
  std::vector<EstimatedLuminaire> truth;
  if (!options.truth_path.empty()) {
    truth = ReadTruth(options.truth_path);
    context.provenance.inputs.push_back(options.truth_path);
  }
  // No trial depends on the earlier chart: it is an input of the artifact, and not part of the log's key.
  const std::string key = KeyOf(options, context);
  const std::vector<StabilityRow> before = RowsBefore(session, options, context);
  TrialLog log(context.out + "/stages/stability_trials.jsonl", key);
  const PreparedSession prepared = PrepareSession(session, context);
  std::fprintf(stderr, "stability the undegraded session\n");
  DegradedSessions sessions(prepared, truth, options.elements, options.seed, context);
  json artifact = ArtifactOf(session, options, sessions, context);
  const std::vector<DegradationResult> results =
      RunTrials(sessions, Allowed(asked, sessions, artifact["skipped"]), options, log);
  for (const DegradationResult& result : results) artifact["edges"].push_back(EdgeJson(result));
  WritePictures(results, before, session.name, options, context.out);
  WriteText(context.out + "/stability.csv", StabilityCsv(results));
  for (const Warning& warning : sessions.undegraded().warnings) {
    if (warning.is_of_outcome) context.warnings.push_back(warning);
  }
  artifact["warnings"] = WarningsJson(context);
  WriteJson(context.out + "/stages/stability.json", artifact);
  return artifact;
}

std::string StabilityTable(const json& artifact) {
  const json& undegraded = artifact["undegraded"];
  std::string text = fmt::format(
      "session {}: {} trials a level, seed {}; against {}\nundegraded: worst luminaire {:.1f} mm, {:.2f} "
      "%\n\n",
      artifact["session"].get<std::string>(), artifact["trials"].get<int>(), artifact["seed"].get<uint64_t>(),
      artifact["reference"].get<std::string>(), 1e3 * NumberOf(undegraded["worst_position_m"]),
      100 * NumberOf(undegraded["worst_flux"]));
  text += "degradation           good up to   fails at      wrong and sure\n";
  for (const json& edge : artifact["edges"]) {
    const auto level = [&](const char* key, const char* none) {
      return edge[key].is_null()
                 ? std::string(none)
                 : fmt::format("{:g} {}", edge[key].get<double>(), edge["unit"].get<std::string>());
    };
    text += fmt::format("{:<21} {:<12} {:<13} {} of {}\n", edge["degradation"].get<std::string>(),
                        level("last_good_level", "none"), level("first_bad_level", "not reached"),
                        edge["confident_wrong"].get<int>(), edge["trials"].get<int>());
  }
  for (const json& skipped : artifact["skipped"])
    text += fmt::format("{:<21} left out: {}\n", skipped["degradation"].get<std::string>(),
                        skipped["because"].get<std::string>());
  return text + "\nsimulated: " + artifact["simulated"].get<std::string>() + "\n";
}

}  // namespace luxfit
