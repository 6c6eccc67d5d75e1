// Noise of the light tracer by kind of luminaire: 15 places at desks, ceiling, floor and walls of a furnished room of 6 m x 4 m x 2.8 m.
//
//   Trace/NAME   one luminaire, 4096 paths a place
// sigma_percent: standard error of the indirect light, rms over the places, of their rms. percent2_s: its square times the
// processor time, the same for any number of paths: half of it is half of the time at equal error.
//   build/release/tests/benchmarks/light_tracer_benchmark
#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <memory>
#include <vector>

#include "forward/light/light_tracer.h"
#include "forward/luminaire/luminaire_parts.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Luminaire Flat(const Eigen::Vector2d& size_m, double height_m) {
  Luminaire luminaire;
  luminaire.position = {2.2, 1.4, height_m};
  luminaire.shape = LuminaireShape::kRectangle;
  luminaire.size_m = size_m;
  luminaire.flux_lm = 1000;
  return luminaire;
}

Luminaire Lobe(double exponent) {
  Luminaire luminaire = Flat({0.08, 0.08}, 2.79);
  luminaire.shape = LuminaireShape::kDisc;
  luminaire.distribution = Distribution::kCosinePower;
  luminaire.cosine_exponent = exponent;
  return luminaire;
}

// `half_deg`: where the intensity is half of the peak.
Luminaire Spot(double half_deg) { return Lobe(std::log(0.5) / std::log(std::cos(half_deg * M_PI / 180))); }

Luminaire Globe() {
  Luminaire luminaire = Flat({0.2, 0.2}, 2.2);
  luminaire.shape = LuminaireShape::kSphere;
  luminaire.distribution = Distribution::kIsotropic;
  return luminaire;
}

Luminaire Pendant() {
  Luminaire luminaire = Flat({1.2, 0.2}, 2.2);
  luminaire.distribution = Distribution::kMeasured;
  luminaire.table = std::make_shared<IntensityTable>(TwoSidedTable(0.4));
  return luminaire;
}

Luminaire Washer() {
  Luminaire luminaire = Spot(15);
  luminaire.position.y() = 0.6;
  luminaire.aim = {0, -0.6, -0.8};
  return luminaire;
}

std::vector<Sensor> Places() {
  std::vector<Sensor> sensors;
  for (const double x : {0.5, 3.1, 5.5}) {
    sensors.push_back({{x, 2.4, 0.85}, {0, 0, 1}, {}});
    sensors.push_back({{x, 1.9, 2.7999}, {0, 0, -1}, {}});
    sensors.push_back({{x, 3.4, 1e-4}, {0, 0, 1}, {}});
    sensors.push_back({{1e-4, 0.3 + x / 2, x / 3}, {1, 0, 0}, {}});
    sensors.push_back({{x, 3.9999, 1.3}, {0, -1, 0}, {}});
  }
  return sensors;
}

void Trace(benchmark::State& state, const Luminaire& luminaire) {
  Scene scene = support::ClosedRoom({6, 4, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  support::AddBox(scene, {Eigen::Vector3d(1, 1, 0.7), Eigen::Vector3d(2.5, 1.8, 0.73)},
                  support::Facing::kOutward, {"desk"});
  support::AddBox(scene, {Eigen::Vector3d(4.5, 0.02, 0), Eigen::Vector3d(5.3, 0.6, 1.6)},
                  support::Facing::kOutward, {"cabinet"});
  Eigen::VectorXd albedo(5);
  albedo << 0.6, 0.25, 0.75, 0.4, 0.4;
  const RayScene rays(scene);
  LightTracerOptions options;
  options.paths_per_sensor = 4096;
  TracedIlluminance lx;
  const std::clock_t start = std::clock();
  for (auto _ : state) lx = TraceIlluminance(scene, rays, {luminaire}, albedo, Places(), options);
  const double cpu_s =
      static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / static_cast<double>(state.iterations());
  const double percent = 100 * lx.indirect_sigma.norm() / lx.indirect.norm();
  state.counters["sigma_percent"] = percent;
  state.counters["percent2_s"] = percent * percent * cpu_s;
}

BENCHMARK_CAPTURE(Trace, panel, Flat({0.6, 0.6}, 2.79))->Iterations(20);
BENCHMARK_CAPTURE(Trace, strip, Flat({1.4, 0.1}, 2.5))->Iterations(20);
BENCHMARK_CAPTURE(Trace, downlight, Lobe(2))->Iterations(20);
BENCHMARK_CAPTURE(Trace, globe, Globe())->Iterations(20);
BENCHMARK_CAPTURE(Trace, pendant, Pendant())->Iterations(20);
BENCHMARK_CAPTURE(Trace, spot_30_deg, Spot(30))->Iterations(20);
BENCHMARK_CAPTURE(Trace, spot_20_deg, Spot(20))->Iterations(20);
BENCHMARK_CAPTURE(Trace, spot_10_deg, Spot(10))->Iterations(20);
BENCHMARK_CAPTURE(Trace, washer_15_deg, Washer())->Iterations(20);

}  // namespace
}  // namespace luxfit
