// Rooms drawn at random, photographed and read by the light tracer: how often is the fit right, warned of, or wrong and sure?
//
//   study_random_rooms -o FOLDER [--quick] [--first SEED] [--count N] [--missing SHARE]
//
// Each seed is one room (tests/support/inverse/random_room.h), which shares no patch and no form factor with the model that is fitted.
// Prints rooms.csv, a line a room, and writes it to FOLDER, with luminaires.csv, a line a luminaire. Success and wrong and sure are those of inverse/study/stability_score.h:
// every luminaire within 50 mm and 10 %; one is not, nor within its own interval, and no warning says so. Ends with 1 where a room is wrong
// and sure. --quick: two small rooms.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "apps/text/formats/artifact.h"
#include "forward/light/room.h"
#include "inverse/fit/fit_room.h"
#include "inverse/study/stability_score.h"
#include "tests/support/inverse/random_room.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

struct Sweep {
  int first = 1, count = 20;
  double missing = 0;
};

Sweep ReadSweep(int argc, char** argv, bool is_quick) {
  Sweep sweep;
  if (is_quick) sweep.count = 2;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--first") == 0) sweep.first = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--count") == 0) sweep.count = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--missing") == 0) sweep.missing = std::atof(argv[i + 1]);
  }
  return sweep;
}

struct Outcome {
  FitScore score;
  bool is_undetermined = false;
  std::string codes;  // of warnings, with spaces between
  double readings_percent = 0, seconds = 0;
  std::string luminaires;  // lines of luminaires.csv, without the seed
};

std::vector<EstimatedLuminaire> TruthOf(const support::TracedRoom& room, const RoomFit& fit) {
  std::vector<EstimatedLuminaire> truth;
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

Outcome FitDrawn(const support::RandomRoom& drawn, std::mt19937_64& rng) {
  RoomOptions options;
  options.patches.patch_size_m = 0.4;
  options.patches.element_size_m = 0.2;
  const Room model = MakeRoom(drawn.mesh, options);
  const RoomObservations given = support::ObserveTraced(drawn.room, model, rng);
  const auto start = std::chrono::steady_clock::now();
  const RoomFit fit = FitRoom(model, given);
  Outcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.is_undetermined = fit.findings.IsUndetermined();
  for (const Warning& warning : fit.findings.warnings)
    outcome.codes += (outcome.codes.empty() ? "" : " ") + warning.code;
  outcome.score =
      ScoreFit(EstimatedLuminaires(fit), TruthOf(drawn.room, fit), !fit.findings.warnings.empty());
  outcome.readings_percent = MeanReadingError(fit, given);
  outcome.luminaires = LuminaireLines(drawn, fit);
  return outcome;
}

std::string Verdict(const Outcome& outcome) {
  if (outcome.score.is_confident_wrong) return "wrong and sure";
  if (!outcome.score.is_success) return "off (warned)";
  return outcome.codes.empty() ? "right" : "right (warned)";
}

int Run(int argc, char** argv) {
  const std::optional<support::StudyOptions> study = support::ReadStudyOptions(argc, argv);
  if (!study) return 2;
  const Sweep sweep = ReadSweep(argc, argv, study->is_quick);
  std::string table =
      "seed,outcome,worst_mm,worst_flux_percent,readings_percent,intervals,intervals_held,undetermined,"
      "seconds,warnings,room\n";
  std::fputs(table.c_str(), stdout);
  std::string luminaires = "seed,luminaire,kind,off_mm,flux_percent,aim_deg,distribution,shape\n";
  int wrong_and_sure = 0;
  for (int seed = sweep.first; seed < sweep.first + sweep.count; ++seed) {
    std::mt19937_64 rng(static_cast<std::uint64_t>(seed));
    support::RandomRoomOptions options;
    options.missing_share = sweep.missing;
    const support::RandomRoom drawn = support::DrawRoom(rng, options);
    const Outcome outcome = FitDrawn(drawn, rng);
    const FitScore& score = outcome.score;
    const std::string line = fmt::format(
        "{},{},{:.1f},{:.2f},{:.2f},{},{},{},{:.1f},{},\"{}\"\n", seed, Verdict(outcome),
        1000 * score.worst_position_m, 100 * score.worst_flux, outcome.readings_percent, score.intervals,
        score.intervals_held, outcome.is_undetermined ? 1 : 0, outcome.seconds, outcome.codes, drawn.words);
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
    table += line;
    for (size_t at = 0; at < outcome.luminaires.size(); at = outcome.luminaires.find('\n', at) + 1)
      luminaires += fmt::format("{},{}", seed,
                                outcome.luminaires.substr(at, outcome.luminaires.find('\n', at) + 1 - at));
    wrong_and_sure += score.is_confident_wrong ? 1 : 0;
  }
  WriteText(study->folder + "/rooms.csv", table);
  WriteText(study->folder + "/luminaires.csv", luminaires);
  return wrong_and_sure == 0 ? 0 : 1;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) { return luxfit::Run(argc, argv); }
