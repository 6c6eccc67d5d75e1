// Counts how many 95 % intervals (1.96 sigma) of fits hold the truth. Each fit has a real room of its own,
// which differs from the given one by errors that are drawn.
//   study_coverage -o FOLDER [--repetitions N] [--quick] [--gate]
//
// The given room is a box of 4 m x 3 m x 2.5 m with 6 facets, 3 materials, 4 views and 3 states, one
// luminaire each. The fit uses a luxmeter reading at each of two places. A repetition draws independent
// normal errors:
//   camera poses         2 mm along and 0.03 degrees about each axis, of a view; common to states
//   survey               5 mm along each axis, of the place of a fitted reading
//   mesh                 5 mm along a facet's normal, 0.1 degrees about each of its edges
//   facet reflectance    1 %, of a facet against its material; common to states
//   element texture      2 %, of an element; common to states and views
//   exposure             0.3 %, of a photo (a view in a state)
//   model error          0 to 4 %, of a facet in a state; the same draws at each level
//   noise                0.5 %, of an observation
//   reading              1 %, of a fitted reading
//   start                50 mm along each axis, 10 % of a flux; no error of the data
// The light is traced or in closed form (coverage_photos.h): it shares no patch, form factor or solution with
// the fit. Only the model error has the form of the clusters that the fit's covariance assumes.
//
// The study judges positions, fluxes, flux ratios, reflectances and predictions of readings that were not
// fitted (coverage_score.h). The true reflectance of a material is the mean over its real facets. The true
// reading is that of an errorless meter at the stated place. A fit that fails misses with everything that it
// does not name as undetermined. Intervals of one repetition are not independent of each other.
//
// Prints a table for each level of model error, and writes FOLDER/fit_coverage.csv and fit_coverage.svg. The
// gate judges the level of 1 %: 90 to 98 % of the intervals hold, and rms z is 0.8 to 1.2.
//   --repetitions  real rooms; default 100, with --quick 8
//   --quick        only the level of 1 %; writes nothing
//   --gate         exit status 1 where one of the five quantities is outside; else the status is 0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "inverse/model/fit_luminaires.h"
#include "tests/support/study_options.h"
#include "tests/validation/coverage/coverage_photos.h"
#include "tests/validation/coverage/coverage_room.h"
#include "tests/validation/coverage/coverage_score.h"

namespace luxfit::coverage {
namespace {

constexpr double kGateLevelPercent = 1;

struct Options {
  support::StudyOptions study;
  int repetitions = 100;
  bool is_gate = false;
};

// Returns nothing, and prints a line on standard error, where the command line is wrong.
std::optional<Options> ReadOptions(int argc, char** argv) {
  const auto study = support::ReadStudyOptions(argc, argv);
  if (!study) return {};
  Options options{*study};
  if (study->is_quick) options.repetitions = 8;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--gate") options.is_gate = true;
    if (word == "--repetitions")
      options.repetitions = i + 1 < argc ? static_cast<int>(std::strtol(argv[i + 1], nullptr, 10)) : 0;
  }
  if (options.repetitions >= 1) return options;
  std::fprintf(stderr, "--repetitions: expected a number from 1\n");
  return {};
}

// Returns a start some way off, as a first guess is.
LightState StartNear(LightState light, std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  for (Luminaire& luminaire : light.luminaires) {
    for (double& coordinate : luminaire.position) coordinate += 0.05 * normal(rng);
    luminaire.flux_lm *= std::exp(0.1 * normal(rng));
  }
  light.albedo.setConstant(0.5);
  return light;
}

// Draws one real room and adds its fits, one for each level, to the levels' scores.
void Repeat(const Setup& setup, unsigned repetition, const std::vector<double>& levels_percent,
            std::vector<Score>& scores) {
  const ErrorSizes sizes;
  std::mt19937_64 rng(repetition);
  const RealRoom real = DrawRealRoom(setup, sizes, rng);
  const RealData taken = TakePhotos(setup, real, sizes, repetition, rng);
  const LightState start = StartNear(setup.light, rng);
  Truth truth{setup.light, taken.reading_lx};
  truth.light.albedo = real.material_albedo;
  for (size_t level = 0; level < levels_percent.size(); ++level) {
    const LightData data = DataWithModelError(setup, real, taken, levels_percent[level] / 100);
    AddFit(FitLuminaires(setup.room, data, start), data, truth, scores[level]);
  }
}

void PrintTable(double level_percent, const Score& score) {
  std::printf("model error %g %%, fits that failed: %d\n", level_percent, score.failed_fits);
  std::printf("  %-22s %8s %7s %6s %13s  %s\n", "", "hold, %", "rms z", "n", "undetermined", "gate");
  for (size_t q = 0; q < kQuantities; ++q) {
    const Tally& tally = score.tallies[q];
    const char* const gate = q >= kGated ? "-" : (tally.IsInGate() ? "inside" : "outside");
    std::printf("  %-22s %8.1f %7.2f %6d %13d  %s\n", kNames[q], 100 * tally.Share(), tally.RmsZ(),
                tally.judged, tally.named, gate);
  }
}

void WriteCsv(const std::string& path, const std::vector<double>& levels_percent,
              const std::vector<Score>& scores) {
  std::ofstream csv(path);
  csv << "facet_error_percent,quantity,intervals,held_percent,rms_z,undetermined,failed_fits\n";
  for (size_t level = 0; level < scores.size(); ++level) {
    for (size_t q = 0; q < kQuantities; ++q) {
      const Tally& tally = scores[level].tallies[q];
      csv << fmt::format("{:g},{},{},{:.1f},{:.2f},{},{}\n", levels_percent[level], kNames[q], tally.judged,
                         100 * tally.Share(), tally.RmsZ(), tally.named, scores[level].failed_fits);
    }
  }
}

void WriteChart(const std::string& path, const std::vector<double>& levels_percent,
                const std::vector<Score>& scores) {
  XyChart chart;
  chart.title = "95 % intervals that hold the truth";
  chart.subtitle = "errors of poses, survey, mesh, reflectance, exposure and noise in each; goal: 90 to 98 %";
  chart.x = {"model error common to a facet and state, %", false, {}, {}};
  chart.y = {"of the intervals, %", false, {}, 100};
  chart.series.reserve(kGated);
  for (size_t q = 0; q < kGated; ++q) {
    XySeries series{kNames[q], {}, {}, true};
    series.points.reserve(scores.size());
    for (size_t level = 0; level < scores.size(); ++level)
      series.points.emplace_back(levels_percent[level], 100 * scores[level].tallies[q].Share());
    chart.series.push_back(series);
  }
  std::ofstream(path) << XyChartsSvg({chart});
}

bool IsInGate(const Score& score) {
  return std::all_of(score.tallies.begin(), score.tallies.begin() + kGated,
                     [](const Tally& tally) { return tally.IsInGate(); });
}

int Run(const Options& options) {
  const Setup setup = MakeSetup();
  const std::vector<double> levels_percent =
      options.study.is_quick ? std::vector<double>{kGateLevelPercent} : std::vector<double>{0, 0.5, 1, 2, 4};
  std::vector<Score> scores(levels_percent.size());
  for (int repetition = 1; repetition <= options.repetitions; ++repetition)
    Repeat(setup, static_cast<unsigned>(repetition), levels_percent, scores);
  bool is_in_gate = true;
  for (size_t level = 0; level < scores.size(); ++level) {
    PrintTable(levels_percent[level], scores[level]);
    if (levels_percent[level] == kGateLevelPercent) is_in_gate = IsInGate(scores[level]);
  }
  if (!options.study.is_quick) {
    WriteCsv(options.study.folder + "/fit_coverage.csv", levels_percent, scores);
    WriteChart(options.study.folder + "/fit_coverage.svg", levels_percent, scores);
  }
  return options.is_gate && !is_in_gate ? 1 : 0;
}

}  // namespace
}  // namespace luxfit::coverage

int main(int argc, char** argv) {
  const auto options = luxfit::coverage::ReadOptions(argc, argv);
  return options ? luxfit::coverage::Run(*options) : 2;
}
