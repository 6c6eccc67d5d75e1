// Light by pairs of rays in rooms of many facets, as simulate computes it: 20 meters, 1 % asked for.
//
//   Pairs/BOXES   so many small boxes of the same total area in a room: more facets, the same light
// estimated_percent, measured: error by ChooseAccuracy's own estimate, and against the light tracer, whose own
// noise is tracer_sigma. cpu_s: of all threads. Pairs/10000 and Pairs/100000 may last longer than a minute:
// nothing cuts them short.
//   build/release/tests/benchmarks/pair_light_benchmark
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <random>

#include "forward/light/choose_accuracy.h"
#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Luminaire CeilingPanel() {
  Luminaire lamp;
  lamp.position = {2.2, 1.4, 2.7};
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.6, 0.6};
  lamp.flux_lm = 1;
  return lamp;
}

// Makes a room with boxes of 3 to 10 cm times `scale` above the floor, turned about z.
Scene RoomWithBoxes(int64_t count, double scale) {
  Scene scene = support::ClosedRoom({6, 4, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const int material = support::MaterialIndex(scene, "box");
  for (int64_t i = 0; i < count; ++i) {
    const Eigen::Vector3d center(0.1 + 5.8 * unit(rng), 0.1 + 3.8 * unit(rng), 0.1 + 1.4 * unit(rng));
    const Eigen::Vector3d half =
        scale * (Eigen::Vector3d::Constant(0.015) + 0.035 * Eigen::Vector3d(unit(rng), unit(rng), unit(rng)));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(unit(rng), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Scene box;
    support::AddBox(box, {-half, half}, support::Facing::kOutward, {"box"});
    for (Facet facet : box.facets) {
      facet.origin = center + turn * facet.origin;
      facet.edge_u = turn * facet.edge_u;
      facet.edge_v = turn * facet.edge_v;
      facet.material = material;
      scene.facets.push_back(facet);
    }
  }
  return scene;
}

Eigen::VectorXd AlbedoOf(const Scene& scene) {
  Eigen::VectorXd albedo(static_cast<Eigen::Index>(scene.materials.size()));
  for (Eigen::Index m = 0; m < albedo.size(); ++m) albedo[m] = m == 1 ? 0.25 : 0.65;  // 1: floor
  return albedo;
}

// Returns the time of all threads: the machine may be shared.
double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void Pairs(benchmark::State& state) {
  LitScene lit;
  lit.scene = RoomWithBoxes(state.range(0), std::sqrt(1000.0 / static_cast<double>(state.range(0))));
  lit.luminaires = {CeilingPanel()};
  lit.albedo_rgb = AlbedoOf(lit.scene).transpose().replicate(3, 1);
  for (int i = 0; i < 20; ++i)
    lit.sensors.push_back({{0.6 + 1.2 * (i % 5), 0.5 + i / 5, 1.7}, Eigen::Vector3d::UnitZ(), {}});
  std::optional<AccurateSceneLight> accurate;
  const double before_s = CpuSeconds();
  for (auto _ : state) accurate.emplace(ChooseAccuracy(lit));
  state.counters["cpu_s"] = CpuSeconds() - before_s;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["process_peak_MB"] = 1e-3 * static_cast<double>(usage.ru_maxrss);
  state.counters["facets"] = static_cast<double>(lit.scene.facets.size());
  state.counters["patches"] = accurate->choice.tried.back().patches;
  state.counters["estimated_percent"] = accurate->choice.estimated_error_percent;
  LightTracerOptions options;
  options.paths_per_sensor = 1 << 16;
  const TracedIlluminance truth = TraceIlluminance(lit.scene, RayScene(lit.scene), lit.luminaires,
                                                   AlbedoOf(lit.scene), lit.sensors, options);
  const Eigen::MatrixXd lx = truth.direct + truth.indirect;
  state.counters["measured"] = RelativeRmsPercent(accurate->light.light.total.cast<double>(), lx);
  state.counters["tracer_sigma"] = RelativeRmsPercent(
      lx + (truth.direct_sigma.array().square() + truth.indirect_sigma.array().square()).sqrt().matrix(), lx);
}
BENCHMARK(Pairs)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
}  // namespace luxfit
