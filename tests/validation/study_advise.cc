// Do photos in the order of `luxfit advise` reach an accuracy earlier than photos in a random one?
//
//   study_advise -o FOLDER [--quick]
//
// Begins with the office from two views (v00 and v03, states A to D: eight photos), and adds photos of the other views that see tags:
// as one call of `advise` orders them, and in five random orders. After each addition the room is fitted anew; the error is the rms of
// the four positions against the truth of the independent renderer. Writes advise.csv and advise.svg. --quick: one photo as advised, and
// fails where it does not halve the error.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "apps/text/formats/artifact.h"
#include "tests/support/apps/advised_office.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

using support::OfficeOutcome;
using support::TakenPhoto;

constexpr std::array<size_t, 7> kAdded = {1, 2, 3, 4, 6, 8, 12};
constexpr int kDraws = 5;

struct Study {
  support::AdvisedOffice office;
  const std::set<TakenPhoto> start = support::FromTwoViews({"A", "B", "C", "D"});
  std::string table = "order,photos_added,position_error_mm,position_sigma_mm,flux_sigma_percent\n";

  OfficeOutcome FitWith(const std::string& order, const std::vector<TakenPhoto>& photos, size_t added) {
    std::set<TakenPhoto> taken = start;
    taken.insert(photos.begin(), photos.begin() + static_cast<std::ptrdiff_t>(added));
    const OfficeOutcome outcome = office.Fit(taken);
    const std::string line =
        fmt::format("{},{},{:.2f},{:.2f},{:.2f}\n", order, added, 1e3 * outcome.position_error_m,
                    1e3 * outcome.position_sigma_m, outcome.flux_sigma_percent);
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
    table += line;
    return outcome;
  }

  // Returns the photos held back, in the table's order.
  std::vector<TakenPhoto> Others() const {
    std::vector<TakenPhoto> others;
    for (const TakenPhoto& photo : support::RegisteredPhotos())
      if (start.count(photo) == 0) others.push_back(photo);
    return others;
  }

  // Advises by the last fit, which must be that of the start.
  std::vector<TakenPhoto> Advised(size_t count) const {
    office.WritePlaces(start);
    std::vector<TakenPhoto> photos;
    for (const nlohmann::json& step : office.Advise(static_cast<int>(count)))
      photos.push_back(support::PhotoOf(step));
    return photos;
  }
};

std::vector<TakenPhoto> Shuffled(std::vector<TakenPhoto> photos, int seed) {
  std::mt19937_64 rng(static_cast<std::uint64_t>(seed));
  std::shuffle(photos.begin(), photos.end(), rng);
  return photos;
}

Eigen::Vector2d PointOf(size_t added, double metres) { return {static_cast<double>(added), 1e3 * metres}; }

std::string ChartOf(const std::vector<Eigen::Vector2d>& advised,
                    const std::vector<std::vector<Eigen::Vector2d>>& random, double all_mm) {
  XyChart chart{"Which photo next?", "the office from two views, and photos added to them", {}, {}, {}};
  chart.x.label = "photos added";
  chart.y.label = "rms error of positions, mm";
  chart.y.is_log = true;
  XySeries median{"random order, median of 5", {}, {}};
  for (size_t i = 0; i < random.front().size(); ++i) {
    std::vector<double> errors;
    for (const auto& draw : random) errors.push_back(draw[i].y());
    std::nth_element(errors.begin(), errors.begin() + kDraws / 2, errors.end());
    median.points.emplace_back(random.front()[i].x(), errors[kDraws / 2]);
  }
  XySeries draws{"random orders", {}, {}, false, XyStyle{"#bbbbbb", 3}};
  for (const auto& draw : random) draws.points.insert(draws.points.end(), draw.begin(), draw.end());
  const double most = random.front().back().x();
  chart.series = {
      {"as advised", advised, {}},
      median,
      draws,
      {"all 43 photos", {{0, all_mm}, {most, all_mm}}, {}, true, XyStyle{"#888888", 0, {}, true}}};
  return XyChartsSvg({chart});
}

int Quick(Study& study) {
  const OfficeOutcome before = study.FitWith("start", {}, 0);
  const OfficeOutcome after = study.FitWith("advised", study.Advised(1), 1);
  return after.position_error_m < before.position_error_m / 2 ? 0 : 1;
}

int Run(int argc, char** argv) {
  const std::optional<support::StudyOptions> options = support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  Study study;
  if (options->is_quick) return Quick(study);
  const OfficeOutcome start = study.FitWith("start", {}, 0);
  const std::vector<TakenPhoto> advised = study.Advised(kAdded.back());
  std::vector<Eigen::Vector2d> as_advised = {PointOf(0, start.position_error_m)};
  for (const size_t added : kAdded)
    if (added <= advised.size())
      as_advised.push_back(PointOf(added, study.FitWith("advised", advised, added).position_error_m));
  const std::vector<TakenPhoto> others = study.Others();
  std::vector<std::vector<Eigen::Vector2d>> random;
  for (int seed = 1; seed <= kDraws; ++seed) {
    random.push_back({PointOf(0, start.position_error_m)});
    for (const size_t added : kAdded)
      random.back().push_back(PointOf(
          added,
          study.FitWith(fmt::format("random {}", seed), Shuffled(others, seed), added).position_error_m));
  }
  const OfficeOutcome all = study.FitWith("all", others, others.size());
  WriteText(options->folder + "/advise.csv", study.table);
  WriteText(options->folder + "/advise.svg", ChartOf(as_advised, random, 1e3 * all.position_error_m));
  return 0;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) { return luxfit::Run(argc, argv); }
