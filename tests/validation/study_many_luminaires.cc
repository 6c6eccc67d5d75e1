// How time and error grow with the number of luminaires.
//
//   study_many_luminaires -o FOLDER [--quick] [--most N] [--only N]
//
// A hall of downlights on a raster of 2.4 m, 3 m high, one of which has aged by 20 %. The light tracer makes photos and readings; nothing
// else is told. Two kinds of sessions: all are on in one state and their number is unknown, and each row has its own switch. --most: the
// largest number, 60 by default. --only: this number alone. Writes many_luminaires.csv and many_luminaires.svg. --quick: six, and fails where they
// are not counted or not found.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/charts/xy_chart_svg.h"
#include "apps/text/formats/artifact.h"
#include "forward/light/room.h"
#include "inverse/fit/fit_room.h"
#include "tests/support/inverse/traced_room.h"
#include "tests/support/inverse/unnamed_luminaires.h"
#include "tests/support/scenes.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSpacing = 2.4, kHeight = 3;
constexpr int kAged = 3;

struct Hall {
  int columns, rows;
  int Count() const { return columns * rows; }
  Eigen::Vector3d Size() const { return {kSpacing * columns, kSpacing * rows, kHeight}; }
};

Luminaire Downlight(const Hall& hall, int number) {
  Luminaire lamp;
  lamp.id = "L" + std::to_string(number + 1);
  lamp.position = {kSpacing * (number % hall.columns + 0.5), kSpacing * (number / hall.columns + 0.5),
                   kHeight - 0.01};
  lamp.shape = LuminaireShape::kDisc;
  lamp.size_m = {0.2, 0};
  lamp.distribution = Distribution::kCosinePower;
  lamp.cosine_exponent = 1;
  lamp.flux_lm = number == kAged ? 1200 : 1500;
  return lamp;
}

// Cameras stand 5 m apart, readings were taken as far apart on the floor.
support::TracedRoom MakeHall(const Hall& hall, bool in_rows) {
  support::TracedRoom room;
  room.truth = support::ClosedRoom(hall.Size(), {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  room.albedo = Eigen::Vector3d(0.6, 0.25, 0.75);
  const int luminaires = hall.Count();
  for (int k = 0; k < luminaires; ++k) room.luminaires.push_back(Downlight(hall, k));
  for (int row = 0; in_rows && row < hall.rows; ++row) {
    room.dimming.emplace_back(Eigen::VectorXd::Zero(luminaires));
    room.dimming.back().segment(Eigen::Index{row} * hall.columns, hall.columns).setOnes();
  }
  room.dimming.emplace_back(Eigen::VectorXd::Ones(luminaires));
  constexpr double kApart = 5;
  const Eigen::Vector3d size = hall.Size();
  const auto stands = [](double length) { return std::max(2, static_cast<int>(std::ceil(length / kApart))); };
  const int along = stands(size.x()), across = stands(size.y());
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      const Eigen::Vector3d eye(size.x() * (i + 0.5) / along + 0.2, size.y() * (j + 0.5) / across - 0.2, 1.6);
      room.eyes.push_back(eye);
      room.places.push_back({{eye.x(), eye.y(), 0}, Eigen::Vector3d::UnitZ(), {}});
    }
  }
  return room;
}

struct Outcome {
  int luminaires = 0, states = 0, observations = 0, found = 0, rounds = 0;
  double count_s = 0, fit_s = 0, worst_mm = 0, worst_flux_percent = 0;
  bool is_whole = false;
};

// Pairs each true luminaire with the nearest one that was found.
void Score(const support::TracedRoom& room, const RoomFit& fit, Outcome& outcome) {
  for (const Luminaire& truth : room.luminaires) {
    const Luminaire* nearest = nullptr;
    for (const Luminaire& found : fit.fit.state.luminaires) {
      if (nearest == nullptr ||
          (found.position - truth.position).norm() < (nearest->position - truth.position).norm())
        nearest = &found;
    }
    outcome.worst_mm = std::max(outcome.worst_mm, 1e3 * (nearest->position - truth.position).norm());
    outcome.worst_flux_percent =
        std::max(outcome.worst_flux_percent, 100 * std::abs(nearest->flux_lm / truth.flux_lm - 1));
  }
}

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Outcome RunHall(const Hall& hall, bool in_rows) {
  const support::TracedRoom room = MakeHall(hall, in_rows);
  // Tracing takes most of the time; it grows with elements times luminaires.
  RoomOptions coarse;
  coarse.patches.patch_size_m = 0.4;
  coarse.patches.element_size_m = 0.2;
  const Room model = MakeRoom(room.truth, coarse);
  std::mt19937_64 rng(1);
  support::TracedRoomOptions options;
  options.paths_per_point = 32;
  RoomObservations given = support::ObserveTraced(room, model, rng, options);
  Outcome outcome;
  outcome.luminaires = hall.Count();
  outcome.states = static_cast<int>(room.dimming.size());
  outcome.observations = static_cast<int>(given.observations.size());
  Clock::time_point start = Clock::now();
  if (!in_rows) {
    Findings findings;
    given = support::WithCounted(model, std::move(given), findings);
    outcome.count_s = SecondsSince(start);
  }
  start = Clock::now();
  const RoomFit fit = FitRoom(model, given);
  outcome.fit_s = SecondsSince(start);
  outcome.found = static_cast<int>(fit.fit.state.luminaires.size());
  outcome.rounds = fit.rounds;
  outcome.is_whole = fit.IsUsable() && fit.absolute;
  Score(room, fit, outcome);
  return outcome;
}

std::string LineOf(const std::string& kind, const Outcome& o) {
  return fmt::format("{},{},{},{},{},{:.1f},{:.1f},{},{:.1f},{:.2f}\n", kind, o.luminaires, o.states,
                     o.observations, o.found, o.count_s, o.fit_s, o.rounds, o.worst_mm, o.worst_flux_percent);
}

int OptionOf(int argc, char** argv, const char* name, int otherwise) {
  for (int i = 1; i + 1 < argc; ++i)
    if (std::strcmp(argv[i], name) == 0) return std::atoi(argv[i + 1]);
  return otherwise;
}

int Run(int argc, char** argv) {
  const std::optional<support::StudyOptions> study = support::ReadStudyOptions(argc, argv);
  if (!study) return 2;
  std::string table =
      "kind,luminaires,states,observations,found,count_s,fit_s,rounds,worst_mm,worst_flux_percent\n";
  std::fputs(table.c_str(), stdout);
  const auto run = [&](const std::string& kind, const Hall& hall) {
    const Outcome outcome = RunHall(hall, kind == "rows");
    const std::string line = LineOf(kind, outcome);
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
    table += line;
    return outcome;
  };
  if (study->is_quick) {
    const Outcome outcome = run("all on", {3, 2});
    return outcome.is_whole && outcome.found == outcome.luminaires && outcome.worst_mm < 30 &&
                   outcome.worst_flux_percent < 15
               ? 0
               : 1;
  }
  const int most = OptionOf(argc, argv, "--most", 60), only = OptionOf(argc, argv, "--only", 0);
  XyChart chart{
      "Time and the number of luminaires", "downlights on a raster, photos by the light tracer", {}, {}, {}};
  chart.x.label = "luminaires";
  chart.y.label = "seconds";
  chart.x.is_log = chart.y.is_log = true;
  for (const std::string kind : {"all on", "rows"}) {
    XySeries series{kind == "rows" ? "each row switched" : "all on, number unknown", {}, {}};
    for (const Hall& hall : {Hall{3, 2}, {4, 3}, {5, 4}, {8, 5}, {10, 6}, {12, 8}, {20, 10}}) {
      if (hall.Count() > most) continue;
      if (only > 0 && hall.Count() != only) continue;
      const Outcome outcome = run(kind, hall);
      series.points.emplace_back(outcome.luminaires, outcome.count_s + outcome.fit_s);
    }
    chart.series.push_back(series);
  }
  WriteText(study->folder + "/many_luminaires.csv", table);
  WriteText(study->folder + "/many_luminaires.svg", XyChartsSvg({chart}));
  return 0;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) { return luxfit::Run(argc, argv); }
