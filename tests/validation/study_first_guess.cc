// The first guess of the office's luminaires: with the places that its photos show and without, and how far
// off such a place may be.
//
//   study_first_guess -o FOLDER [--quick]
//
// Prints for each luminaire where the guess is, off the truth by how much, and the processor's time of all
// guesses, for several grids of the search. Writes first_guess_offset.csv|svg: the place seen is moved off
// the truth by r in directions drawn at random, beside the washed-out tags and walls that the photos show;
// how often it is used as it is, and how far off the guess ends. Ends with 1 where a place a metre off is
// used, or a true one is not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "apps/stages/prepared_session.h"
#include "apps/stages/session_light.h"
#include "apps/text/formats/artifact.h"
#include "inverse/fit/internal/room_light.h"
#include "inverse/model/internal/measured_indirect.h"
#include "inverse/model/internal/search/first_guess.h"
#include "tests/paths.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

const std::string kOffice = std::string(LUXFIT_FIXTURES) + "/office/";

double CpuS() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Office {
  PreparedSession prepared;
  LightData data;
  std::vector<Eigen::Vector3d> truth;
};

Office PrepareOffice(const std::string& folder) {
  RunContext context;
  context.out = folder;
  context.is_quiet = true;
  Office office{PrepareSession(ReadSession(kOffice + "session.toml"), context), {}, {}};
  const RoomObservations observed = RoomObservationsOf(office.prepared.session, office.prepared.linearized,
                                                       office.prepared.room, office.prepared.observed);
  const LightData data = LightOf(office.prepared.room, observed).data;
  office.data = WithMeasuredIndirect(office.prepared.room, data);
  for (const EstimatedLuminaire& lamp : ReadTruth(kOffice + "truth.json"))
    office.truth.push_back(lamp.position);
  return office;
}

FirstGuess GuessOf(const Office& office, const std::vector<SeenPlace>& seen, double grid_m) {
  FirstGuessOptions options;
  options.grid_m = grid_m;
  return GuessLuminaires(office.prepared.room, office.data, {}, seen, {}, options);
}

double OffMm(const Office& office, const FirstGuess& guess, size_t k) {
  return guess.luminaires[k].found ? 1000 * (guess.luminaires[k].position - office.truth[k]).norm() : NAN;
}

void CompareWithSearch(const Office& office) {
  std::printf(
      "first guess            off by (mm): A       B       C       D    residual (%%): A to D    CPU s\n");
  const auto print = [&](const std::string& name, const std::vector<SeenPlace>& seen, double grid_m) {
    const double start_s = CpuS();
    const FirstGuess guess = GuessOf(office, seen, grid_m);
    const double cpu_s = CpuS() - start_s;
    std::string line = fmt::format("{:<30}", name);
    for (size_t k = 0; k < guess.luminaires.size(); ++k)
      line += fmt::format("{:8.1f}", OffMm(office, guess, k));
    line += "   ";
    for (const LuminaireGuess& l : guess.luminaires)
      line += fmt::format("{:6.2f}", 100 * l.relative_residual);
    std::printf("%s %10.2f\n", line.c_str(), cpu_s);
  };
  print("seen in photos", office.prepared.observed.seen, FirstGuessOptions{}.grid_m);
  for (const double grid_m : {0.4, 0.37, 0.43, 0.5})
    print(fmt::format("search, grid of {} m", grid_m), {}, grid_m);
}

// The places seen, those within half a metre of a luminaire replaced by one at `r_m` from each.
std::vector<SeenPlace> Moved(const Office& office, double r_m, std::mt19937_64& rng) {
  std::vector<SeenPlace> places;
  std::normal_distribution<double> normal;
  constexpr double kOwnM = 0.5;
  for (const SeenPlace& place : office.prepared.observed.seen) {
    if (std::all_of(office.truth.begin(), office.truth.end(),
                    [&](const Eigen::Vector3d& p) { return (p - place.position).norm() > kOwnM; }))
      places.push_back(place);
  }
  for (size_t k = 0; k < office.truth.size(); ++k) {
    SeenPlace place;
    const Eigen::AlignedBox3d box = office.prepared.room.scene.Bounds();
    do {
      const Eigen::Vector3d direction(normal(rng), normal(rng), normal(rng));
      place.position = office.truth[k] + r_m * direction.normalized();
    } while (!box.contains(place.position));
    for (size_t s = 0; s < office.data.dimming.size(); ++s) {
      const Eigen::VectorXd& dimming = office.data.dimming[s];
      if (dimming[static_cast<Eigen::Index>(k)] > 0) place.states.push_back(static_cast<int>(s));
    }
    places.push_back(place);
  }
  return places;
}

bool StudyOffsets(const Office& office, const std::string& folder, bool is_quick) {
  std::string csv = "offset_m,used_percent,residual_percent,guess_off_mm_median,guess_off_mm_worst\n";
  XyChart chart{"First guess: a place seen in photos that is off by r",
                "office, four luminaires; beside it the washed-out tags and walls that the photos show",
                {"r, m", false, {}, {}},
                {"%", false, 0, 100},
                {{"used without a search", {}, {}}}};
  bool is_good = true;
  const std::vector<double> offsets =
      is_quick ? std::vector<double>{0, 1}
               : std::vector<double>{0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1};
  for (const double r_m : offsets) {
    std::mt19937_64 rng(5);
    int used = 0, all = 0;
    std::vector<double> off_mm, residual;
    for (int draw = 0; draw < (is_quick ? 1 : 4); ++draw) {
      const FirstGuess guess = GuessOf(office, Moved(office, r_m, rng), FirstGuessOptions{}.grid_m);
      for (size_t k = 0; k < guess.luminaires.size(); ++k) {
        ++all;
        used += guess.luminaires[k].was_searched ? 0 : 1;
        off_mm.push_back(OffMm(office, guess, k));
        residual.push_back(100 * guess.luminaires[k].relative_residual);
      }
    }
    std::sort(off_mm.begin(), off_mm.end());
    std::sort(residual.begin(), residual.end());
    const double percent = 100.0 * used / all;
    csv += fmt::format("{},{:.0f},{:.1f},{:.0f},{:.0f}\n", r_m, percent, residual[residual.size() / 2],
                       off_mm[off_mm.size() / 2], off_mm.back());
    chart.series[0].points.emplace_back(r_m, percent);
    if ((r_m == 0 && used < all) || (r_m == 1 && used > 0)) is_good = false;
  }
  std::printf("\n%s", csv.c_str());
  WriteText(folder + "/first_guess_offset.csv", csv);
  WriteText(folder + "/first_guess_offset.svg", XyChartsSvg({chart}));
  return is_good;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) {
  const auto options = luxfit::support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  const luxfit::Office office = luxfit::PrepareOffice(options->folder);
  if (!options->is_quick) luxfit::CompareWithSearch(office);
  return luxfit::StudyOffsets(office, options->folder, options->is_quick) ? 0 : 1;
}
