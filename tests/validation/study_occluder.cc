// A luminaire started on the wrong side of a partition: does it find its way?
//
//   study_occluder -o FOLDER [--quick]
//
// Readings from closed forms (tests/support/inverse/partition_readings.h), luminaires before the partition and starts
// behind it drawn at random. Of each way, how many starts end within 5 cm of the luminaire, and the
// processor's time: the fit with visibility as it is, the fit with that of balls of 0.4, 0.2 and 0.1 m about
// the luminaire first (blurred to sharp), a descent without derivatives on the light's squares with and
// without such balls, and the search over places, which needs no start. Prints occluder.csv and writes it to
// FOLDER. Ends with 1 where the search misses one.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "apps/text/formats/artifact.h"
#include "forward/direct/direct_light.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/search/first_guess.h"
#include "tests/support/inverse/partition_readings.h"
#include "tests/support/inverse/plane_readings.h"
#include "tests/support/study_options.h"

namespace luxfit {
namespace {

using Eigen::Vector3d;

constexpr double kFluxLm = 800;
const std::vector<double> kRadiiM = {0.4, 0.2, 0.1, 0};

double CpuS() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// A ball in what sees it; its light is that of a point.
Luminaire BallAt(const Vector3d& position, double radius_m) {
  Luminaire ball;
  ball.position = position;
  ball.distribution = Distribution::kIsotropic;
  ball.shape = radius_m > 0 ? LuminaireShape::kSphere : LuminaireShape::kPoint;
  ball.size_m.setConstant(2 * radius_m);
  return ball;
}

Vector3d Fitted(const Room& room, const LightData& data, const Vector3d& position,
                const std::vector<double>& radii_m) {
  FitLuminairesOptions options;
  options.covariance = false;
  LightState state = support::CosinePowerStart(position, 1);
  state.free[0].exponent = false;
  state.albedo = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(room.scene.materials.size()), 0.01);
  state.albedo_free.assign(room.scene.materials.size(), false);
  for (const double radius_m : radii_m) {
    const double flux_lm = state.luminaires[0].flux_lm;
    state.luminaires[0] = BallAt(state.luminaires[0].position, radius_m);
    state.luminaires[0].flux_lm = flux_lm;
    options.max_outer_iterations = radius_m > 0 ? 4 : 12;
    state = FitLuminaires(room, data, state, {}, options).state;
  }
  return state.luminaires[0].position;
}

// Squares left over, the flux the best there is.
double Squares(const Room& room, const LightData& data, const Vector3d& position, double radius_m) {
  const Luminaire ball = BallAt(position, radius_m);
  double mean_lx = 0, dd = 0, de = 0, ee = 0;
  for (const Reading& r : data.readings)
    mean_lx += r.illuminance_lx / static_cast<double>(data.readings.size());
  for (const Reading& r : data.readings) {
    const Sensor& s = r.sensor;
    const double weight = 1 / (0.1 * r.illuminance_lx + 0.02 * mean_lx);
    const double d = weight * VisibleFraction(room.rays, ball, s.position, s.normal, 4) *
                     DirectIlluminancePerLumen(ball, s.position, s.normal).lx_per_lm;
    const double e = weight * r.illuminance_lx;
    dd += d * d, de += d * e, ee += e * e;
  }
  return dd > 0 ? ee - de * de / dd : ee;
}

Vector3d Descended(const Room& room, const LightData& data, Vector3d at, const std::vector<double>& radii_m) {
  constexpr double kFirstM = 0.2, kLastM = 0.01;
  for (const double radius_m : radii_m) {
    double squares = Squares(room, data, at, radius_m);
    for (double step_m = kFirstM; step_m > kLastM;) {
      Vector3d best = at;
      for (int k = 0; k < 6; ++k) {
        Vector3d next = at;
        next[k / 2] += k % 2 == 0 ? step_m : -step_m;
        if (!room.scene.Bounds().contains(next)) continue;
        const double there = Squares(room, data, next, radius_m);
        if (there < squares) squares = there, best = next;
      }
      if (best == at) step_m /= 2;
      at = best;
    }
  }
  return at;
}

struct Way {
  std::string name;
  std::function<Vector3d(const Room&, const LightData&, const Vector3d&)> end;
  int found = 0;
  double cpu_s = 0;
};

std::vector<Way> Ways() {
  const std::vector<double> sharp = {0};
  return {{"fit, visibility sharp",
           [=](const Room& r, const LightData& d, const Vector3d& s) { return Fitted(r, d, s, sharp); }},
          {"fit, visibility blurred to sharp",
           [](const Room& r, const LightData& d, const Vector3d& s) { return Fitted(r, d, s, kRadiiM); }},
          {"descent, visibility sharp",
           [=](const Room& r, const LightData& d, const Vector3d& s) { return Descended(r, d, s, sharp); }},
          {"descent, visibility blurred to sharp",
           [](const Room& r, const LightData& d, const Vector3d& s) { return Descended(r, d, s, kRadiiM); }},
          {"search over places, no start", [](const Room& r, const LightData& d, const Vector3d&) {
             return GuessLuminaires(r, d).luminaires.at(0).position;
           }}};
}

bool Study(const std::string& folder, bool is_quick) {
  constexpr double kFoundM = 0.05;
  const Room room = MakeRoom(support::PartitionScene(), {{1, 1}, {16}});
  const int trials = is_quick ? 2 : 30;
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> u(0, 1);
  std::vector<Way> ways = Ways();
  for (int i = 0; i < trials; ++i) {
    const Vector3d lamp(0.3 + 1.5 * u(rng), -1 + 2 * u(rng), 0.5 + u(rng));
    const Vector3d start(-0.1 - 0.4 * u(rng), -0.5 + u(rng), 0.5 + 0.5 * u(rng));
    const LightData data = support::PartitionReadings(lamp, kFluxLm);
    for (Way& way : ways) {
      const double start_s = CpuS();
      way.found += (way.end(room, data, start) - lamp).norm() < kFoundM ? 1 : 0;
      way.cpu_s += CpuS() - start_s;
    }
  }
  std::string csv = "way,found,of,cpu_s_each\n";
  for (const Way& way : ways)
    csv += fmt::format("\"{}\",{},{},{:.2f}\n", way.name, way.found, trials, way.cpu_s / trials);
  std::printf("%s", csv.c_str());
  WriteText(folder + "/occluder.csv", csv);
  return ways.back().found == trials;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) {
  const auto options = luxfit::support::ReadStudyOptions(argc, argv);
  if (!options) return 2;
  return luxfit::Study(options->folder, options->is_quick) ? 0 : 1;
}
