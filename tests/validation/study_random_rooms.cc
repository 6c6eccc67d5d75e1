// Rooms drawn at random, photographed and read by the light tracer: how often is the fit right, warned of, or wrong and sure?
//
//   study_random_rooms -o FOLDER [--quick] [--first SEED] [--count N] [--luminaires MOST] [--degrade NAME,...|all] [--apply] [--estimate]
//
// Each seed is one room (tests/support/inverse/random_room.h), which shares no patch and no form factor with the model that is fitted.
// --degrade: a room that is right as it is is fitted again with each level of each degradation named
// (tests/validation/random_rooms/room_degradations.h). --luminaires: rooms that have more are left out.
// --apply: explanations that stand alone are taken as right, as `luxfit run --apply` does.
// --estimate: photos and readings of the last state alone, in which all are on, and nobody says how many there are.
// Prints rooms.csv, a line a fit, and writes it to FOLDER, with luminaires.csv, a line a luminaire, warnings.csv, a line a warning, and
// with --degrade degradations.csv, a line a level.
// Success and wrong and sure are those of inverse/study/stability_score.h: every luminaire within 50 mm and 10 %; one is not, nor within its own interval, and no
// warning says so. A warning that the room gives as it is says nothing of a degradation. Ends with 1 where a fit is wrong and sure. --quick: two small rooms, two degradations.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/text/formats/artifact.h"
#include "forward/light/room.h"
#include "inverse/fit/fit_room.h"
#include "inverse/study/stability_score.h"
#include "tests/support/inverse/random_room.h"
#include "tests/support/inverse/unnamed_luminaires.h"
#include "tests/support/study_options.h"
#include "tests/validation/random_rooms/room_degradations.h"
#include "tests/validation/random_rooms/run_traced.h"

namespace luxfit {
namespace {

struct Sweep {
  int first = 1, count = 20, most_luminaires = 100;
  std::vector<RoomDegradation> degradations;
  bool applies = false;    // as `luxfit run --apply`
  bool estimates = false;  // the number of luminaires
};

std::vector<RoomDegradation> DegradationsNamed(const std::string& names) {
  std::vector<RoomDegradation> named;
  for (const RoomDegradation& d : RoomDegradations())
    if (names == "all" || ("," + names + ",").find("," + d.name + ",") != std::string::npos)
      named.push_back(d);
  return named;
}

Sweep ReadSweep(int argc, char** argv, bool is_quick) {
  Sweep sweep;
  if (is_quick) sweep.count = 2, sweep.degradations = DegradationsNamed("photos_exchanged,reading");
  for (int i = 1; i < argc; ++i) {
    sweep.applies = sweep.applies || std::strcmp(argv[i], "--apply") == 0;
    sweep.estimates = sweep.estimates || std::strcmp(argv[i], "--estimate") == 0;
  }
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--first") == 0) sweep.first = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--count") == 0) sweep.count = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--luminaires") == 0) sweep.most_luminaires = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--degrade") == 0) sweep.degradations = DegradationsNamed(argv[i + 1]);
  }
  return sweep;
}

struct Outcome {
  FitScore score;
  bool is_undetermined = false;
  std::vector<Warning> warnings;  // those that the room does not give as it is
  int found = 0;                  // luminaires
  double readings_percent = 0, seconds = 0;
  std::string luminaires;  // lines of luminaires.csv, without what is degraded and the seed
};

bool IsOfRightNumber(const support::TracedRoom& room, const RoomFit& fit) {
  return fit.fit.state.luminaires.size() == room.luminaires.size();
}

// Under the names of the fit, where it has as many.
std::vector<EstimatedLuminaire> TruthOf(const support::TracedRoom& room, const RoomFit& fit) {
  std::vector<EstimatedLuminaire> truth;
  if (!IsOfRightNumber(room, fit)) {
    for (const Luminaire& l : room.luminaires) truth.push_back({l.id, l.position, {}, l.flux_lm, 0});
    return truth;
  }
  const std::vector<size_t> matches = support::MatchesOf(room, fit);
  for (size_t k = 0; k < room.luminaires.size(); ++k) {
    const Luminaire& luminaire = room.luminaires[k];
    truth.push_back({fit.fit.state.luminaires[matches[k]].id, luminaire.position, {}, luminaire.flux_lm, 0});
  }
  return truth;
}

double MeanReadingError(const RoomFit& fit, const RoomObservations& given) {
  const std::vector<PredictedReading> predicted = PredictedReadings(fit);
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < predicted.size(); ++i) {
    if (given.meter.readings[i].used || !predicted[i].is_known) continue;
    sum += std::abs(predicted[i].illuminance_lx / given.meter.readings[i].illuminance_lx - 1), ++count;
  }
  return count > 0 ? 100 * sum / count : std::nan("");
}

std::string LuminaireLines(const support::RandomRoom& drawn, const RoomFit& fit) {
  if (!IsOfRightNumber(drawn.room, fit)) return "";
  const std::vector<size_t> matches = support::MatchesOf(drawn.room, fit);
  std::string lines;
  for (size_t k = 0; k < matches.size(); ++k) {
    const Luminaire& truth = drawn.room.luminaires[k];
    const Luminaire& found = fit.fit.state.luminaires[matches[k]];
    lines += fmt::format("{},{},{:.1f},{:.2f},{:.2f},{},{}\n", truth.id, drawn.kinds[k],
                         1000 * (found.position - truth.position).norm(),
                         100 * (found.flux_lm / truth.flux_lm - 1),
                         180 / M_PI * std::atan2(found.aim.cross(truth.aim).norm(), found.aim.dot(truth.aim)),
                         ToString(found.distribution), ToString(found.shape));
  }
  return lines;
}

// The codes of warnings that the room gives as it is.
using KnownCodes = std::set<std::string>;

// `drawn`: the room as it is said to be. `model`: of its mesh.
Outcome FitGiven(const support::RandomRoom& drawn, const Room& model, RoomObservations given,
                 const Sweep& sweep, const KnownCodes& known) {
  const auto start = std::chrono::steady_clock::now();
  Findings of_count;
  if (sweep.estimates) given = support::WithCounted(model, std::move(given), of_count);
  RoomFit fit = RunTraced(model, given, sweep.applies);
  fit.findings.warnings.insert(fit.findings.warnings.begin(), of_count.warnings.begin(),
                               of_count.warnings.end());
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.is_undetermined = fit.findings.IsUndetermined();
  for (const Warning& warning : fit.findings.warnings)
    if (known.count(warning.code) == 0) outcome.warnings.push_back(warning);
  outcome.found = static_cast<int>(fit.fit.state.luminaires.size());
  outcome.score = ScoreFit(EstimatedLuminaires(fit), TruthOf(drawn.room, fit), !outcome.warnings.empty());
  if (!IsOfRightNumber(drawn.room, fit)) {
    outcome.score.is_success = false;
    outcome.score.is_confident_wrong = outcome.warnings.empty();
  }
  outcome.readings_percent = MeanReadingError(fit, given);
  outcome.luminaires = LuminaireLines(drawn, fit);
  return outcome;
}

Room ModelOf(const Scene& mesh) {
  RoomOptions options;
  options.patches.patch_size_m = 0.4;
  options.patches.element_size_m = 0.2;
  return MakeRoom(mesh, options);
}

// The table of states stays as drawn, whatever the room does.
RoomObservations Photograph(const support::RandomRoom& drawn, const Room& model,
                            const std::vector<Eigen::VectorXd>& table, std::mt19937_64 rng) {
  RoomObservations given = support::ObserveTraced(drawn.room, model, rng);
  given.dimming = table;
  return given;
}

std::string Verdict(const Outcome& outcome) {
  if (outcome.score.is_confident_wrong) return "wrong and sure";
  if (!outcome.score.is_success) return outcome.warnings.empty() ? "off (within intervals)" : "off (warned)";
  return outcome.warnings.empty() ? "right" : "right (warned)";
}

bool Names(const Warning& warning, const NamedCause& cause) {
  return warning.code == cause.code &&
         std::all_of(cause.words.begin(), cause.words.end(), [&](const std::string& words) {
           return warning.message.find(words) != std::string::npos;
         });
}

// "first": the first warning names the cause; "later": another does; "else": its code names something else.
std::string Naming(const Outcome& outcome, const NamedCause& cause) {
  if (cause.code.empty()) return "";
  const auto& warnings = outcome.warnings;
  const auto is_it = [&](const Warning& w) { return Names(w, cause); };
  const auto is_of_code = [&](const Warning& w) { return w.code == cause.code; };
  if (!warnings.empty() && is_it(warnings.front())) return "first";
  if (std::any_of(warnings.begin(), warnings.end(), is_it)) return "later";
  return std::any_of(warnings.begin(), warnings.end(), is_of_code) ? "else" : "no";
}

// Codes of warnings that accuse something, other than the cause's.
std::string Accused(const Outcome& outcome, const NamedCause& cause) {
  static const std::set<std::string> kAccusing{
      "states_as_if",       "photos_as_if",   "exposure_metadata",
      "state_contradicted", "readings_as_if", "reading_disagrees",
      "unmodelled_surface", "flux_deviates",  "luminaire_unlike_others"};
  std::set<std::string> accused;
  for (const Warning& warning : outcome.warnings)
    if (kAccusing.count(warning.code) > 0 && warning.code != cause.code) accused.insert(warning.code);
  return fmt::format("{}", fmt::join(accused, " "));
}

std::string CodesOf(const std::vector<Warning>& warnings) {
  std::vector<std::string> codes;
  codes.reserve(warnings.size());
  for (const Warning& warning : warnings) codes.push_back(warning.code);
  return fmt::format("{}", fmt::join(codes, " "));
}

// Counts what became of the rooms by degradation and level, in their order.
class Tally {
 public:
  void Add(const std::string& key, const Outcome& outcome, const NamedCause& cause) {
    if (counts_.count(key) == 0) keys_.push_back(key);
    std::map<std::string, int>& count = counts_[key];
    for (const std::string& what :
         {std::string("rooms"), Verdict(outcome), "named " + Naming(outcome, cause),
          std::string(Accused(outcome, cause).empty() ? "accuses none" : "accuses other")})
      ++count[what];
  }
  std::string Table() {
    const std::vector<std::string> columns{
        "rooms",          "right",       "right (warned)", "off (warned)", "off (within intervals)",
        "wrong and sure", "named first", "named later",    "named else",   "named no",
        "accuses other"};
    std::string table = fmt::format("degradation,level,{}\n", fmt::join(columns, ","));
    for (const std::string& key : keys_) {
      table += key;
      for (const std::string& column : columns) table += fmt::format(",{}", counts_[key][column]);
      table += "\n";
    }
    return table;
  }

 private:
  std::vector<std::string> keys_;
  std::map<std::string, std::map<std::string, int>> counts_;
};

// Draws, degrades and fits rooms, and keeps what the tables say of them.
class RoomSweep {
 public:
  explicit RoomSweep(std::string folder) : folder_(std::move(folder)) { std::fputs(rooms_.c_str(), stdout); }

  void Run(const Sweep& sweep) {
    for (int seed = sweep.first; seed < sweep.first + sweep.count; ++seed) RunSeed(seed, sweep);
    WriteText(folder_ + "/rooms.csv", rooms_);
    WriteText(folder_ + "/luminaires.csv", luminaires_);
    WriteText(folder_ + "/warnings.csv", warnings_);
    if (!sweep.degradations.empty()) WriteText(folder_ + "/degradations.csv", tally_.Table());
  }
  bool IsAnyWrongAndSure() const { return is_any_wrong_; }

 private:
  void RunSeed(int seed, const Sweep& sweep) {
    std::mt19937_64 rng(static_cast<std::uint64_t>(seed));
    support::RandomRoom drawn = support::DrawRoom(rng);
    if (sweep.estimates) drawn.room.dimming = {drawn.room.dimming.back()};
    if (static_cast<int>(drawn.room.luminaires.size()) > sweep.most_luminaires) return;
    const Room model = ModelOf(drawn.mesh);
    const RoomObservations given = Photograph(drawn, model, drawn.room.dimming, rng);
    const Outcome as_is = FitGiven(drawn, model, given, sweep, {});
    Add("none,", seed, drawn, as_is, {});
    if (!as_is.score.is_success) return;
    KnownCodes known;
    for (const Warning& warning : as_is.warnings) known.insert(warning.code);
    for (const RoomDegradation& degradation : sweep.degradations)
      for (const double level : degradation.levels) {
        // The same random numbers at every level.
        std::mt19937_64 worse(static_cast<std::uint64_t>(seed));
        support::RandomRoom room = drawn;
        RoomObservations data = given;
        const std::optional<NamedCause> cause = degradation.of_room != nullptr
                                                    ? degradation.of_room(level, worse, room)
                                                    : degradation.of_data(level, worse, data);
        if (!cause) continue;
        const Room worse_model = ModelOf(room.mesh);
        if (degradation.of_room != nullptr) data = Photograph(room, worse_model, drawn.room.dimming, rng);
        const std::string key = fmt::format("{},{:g}", degradation.name, level);
        const Outcome outcome = FitGiven(drawn, worse_model, data, sweep, known);
        Add(key, seed, drawn, outcome, *cause);
        tally_.Add(key, outcome, *cause);
      }
  }

  void Add(const std::string& key, int seed, const support::RandomRoom& drawn, const Outcome& outcome,
           const NamedCause& cause) {
    const FitScore& score = outcome.score;
    const std::string line =
        fmt::format("{},{},{},{},{},{} of {},{:.1f},{:.2f},{:.2f},{},{},{},{:.1f},{},\"{}\"\n", key, seed,
                    Verdict(outcome), Naming(outcome, cause), Accused(outcome, cause), outcome.found,
                    drawn.room.luminaires.size(), 1000 * score.worst_position_m, 100 * score.worst_flux,
                    outcome.readings_percent, score.intervals, score.intervals_held,
                    outcome.is_undetermined ? 1 : 0, outcome.seconds, CodesOf(outcome.warnings), drawn.words);
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
    rooms_ += line;
    const std::string& of = outcome.luminaires;
    for (size_t at = 0; at < of.size(); at = of.find('\n', at) + 1)
      luminaires_ += fmt::format("{},{},{}", key, seed, of.substr(at, of.find('\n', at) + 1 - at));
    for (const Warning& warning : outcome.warnings)
      warnings_ += fmt::format("{},{},{},\"{}\"\n", key, seed, warning.code, warning.message);
    is_any_wrong_ = is_any_wrong_ || score.is_confident_wrong;
  }

  std::string folder_;
  std::string rooms_ =
      "degradation,level,seed,outcome,named,accused,found,worst_mm,worst_flux_percent,readings_percent,"
      "intervals,"
      "intervals_held,undetermined,seconds,warnings,room\n";
  std::string luminaires_ =
      "degradation,level,seed,luminaire,kind,off_mm,flux_percent,aim_deg,distribution,shape\n";
  std::string warnings_ = "degradation,level,seed,code,message\n";
  Tally tally_;
  bool is_any_wrong_ = false;
};

int Run(int argc, char** argv) {
  const std::optional<support::StudyOptions> study = support::ReadStudyOptions(argc, argv);
  if (!study) return 2;
  RoomSweep rooms(study->folder);
  rooms.Run(ReadSweep(argc, argv, study->is_quick));
  return rooms.IsAnyWrongAndSure() ? 1 : 0;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) { return luxfit::Run(argc, argv); }
