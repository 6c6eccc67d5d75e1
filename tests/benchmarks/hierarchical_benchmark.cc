// Hierarchical radiosity: leaves, links, time, memory and error.
//
//   AskedError/ROOM/ASKED   rooms empty, with a partition, furnished, with thin legs and small things; ASKED:
//                           percent x 10
//   Clutter/BOXES           boxes of 3 to 10 cm in the room, 20 % asked for: the more, the less light passes
//   Detail/BOXES            as many boxes of the same total area: more facets, the same light
//   Pairs/BOXES             the same rooms without hierarchy, as simulate does it: ChooseAccuracy, 20 meters,
//   1 %
//                           asked for; patches, estimated_percent, measured
// measured, bias, direct, direct_bias: of points spread by area, from the light tracer (its own noise taken
// off), in percent of the mean; rms, mean, and both of direct light alone.
// cpu_s: of all threads. AskedError/3/50, Clutter/10000 and Detail from 1600 on may last longer than two
// minutes: nothing cuts them short.
//   build/release/tests/benchmarks/hierarchical_benchmark
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "forward/direct/internal/shadowed_light.h"
#include "forward/light/choose_accuracy.h"
#include "forward/light/light_tracer.h"
#include "forward/light/room.h"
#include "forward/radiosity/internal/hierarchical.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

Luminaire CeilingPanel() {
  Luminaire lamp;
  lamp.position = {2.2, 1.4, 2.7};
  lamp.shape = LuminaireShape::kRectangle;
  lamp.size_m = {0.6, 0.6};
  lamp.flux_lm = 4000;
  return lamp;
}

Scene EmptyRoom() {
  return support::ClosedRoom({6, 4, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
}

void AddSolid(Scene& scene, const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  support::AddBox(scene, {min, max}, support::Facing::kOutward, {"box"});
}

// Boxes of 3 to 10 cm times `scale` above the floor, turned about z.
void AddBoxes(Scene& scene, int64_t count, double scale) {
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
}

// A top of 3 cm on four legs of 3 cm.
void AddTable(Scene& scene, const Eigen::Vector2d& corner, const Eigen::Vector2d& size) {
  constexpr double kThick = 0.03, kHeight = 0.72;
  const auto at = [&](double x, double y, double z) {
    return Eigen::Vector3d(corner[0] + x, corner[1] + y, z);
  };
  AddSolid(scene, at(0, 0, kHeight), at(size[0], size[1], kHeight + kThick));
  for (const double x : {0.02, size[0] - 0.02 - kThick}) {
    for (const double y : {0.02, size[1] - 0.02 - kThick})
      AddSolid(scene, at(x, y, 0), at(x + kThick, y + kThick, kHeight));
  }
}

enum RoomKind { kEmpty, kPartition, kFurnished, kLegs };

Scene MakeScene(int64_t kind) {
  Scene scene = EmptyRoom();
  if (kind == kPartition) AddSolid(scene, {3.4, 0, 0}, {3.5, 2.6, 2.8});
  if (kind == kFurnished) {
    AddSolid(scene, {0.6, 0.5, 0}, {1.4, 1.5, 1.1});
    AddSolid(scene, {2.6, 1.0, 0.9}, {3.3, 2.2, 1.0});
  }
  if (kind == kLegs) {
    AddTable(scene, {0.8, 0.6}, {1.4, 0.7});
    AddTable(scene, {3.0, 2.2}, {1.6, 0.8});
    AddBoxes(scene, 100, 1);
  }
  return scene;
}

Eigen::VectorXd AlbedoOf(const Scene& scene) {
  Eigen::VectorXd albedo(static_cast<Eigen::Index>(scene.materials.size()));
  for (Eigen::Index m = 0; m < albedo.size(); ++m) albedo[m] = m == 1 ? 0.25 : 0.65;  // 1: floor
  return albedo;
}

// Penumbras as fine as the error that is asked for needs them: the share of the panel in steps of 1 / 16 or
// less.
DirectLight DirectLightOf(const RayScene& rays, const Luminaire& lamp, double error_percent) {
  ShadowOptions shadows;
  shadows.refinements = error_percent >= 20 ? 0 : (error_percent >= 10 ? 1 : 2);
  return [&rays, &lamp, shadows](const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    return lamp.flux_lm * VisibleIlluminancePerLumen(rays, lamp, p, normal, shadows);
  };
}

void Report(benchmark::State& state, const HierarchicalSolution& solution) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["leaves"] = static_cast<double>(solution.elements.size());
  state.counters["links"] = static_cast<double>(solution.link_count);
  state.counters["cluster_links"] = static_cast<double>(solution.cluster_link_count);
  state.counters["estimated_percent"] = solution.error_percent;
  state.counters["tree_MB"] = 1e-6 * static_cast<double>(solution.memory_bytes);
  state.counters["process_peak_MB"] = 1e-3 * static_cast<double>(usage.ru_maxrss);
}

// Points spread by area, each on the leaf that holds it, against the light tracer.
void CompareWithTracer(benchmark::State& state, const Scene& scene, const RayScene& rays,
                       const Luminaire& lamp, const HierarchicalSolution& solution) {
  constexpr int kPoints = 3000;
  std::mt19937_64 rng(2);
  std::vector<double> area;
  area.reserve(solution.elements.size());
  for (const HierarchicalElement& element : solution.elements) area.push_back(element.area_m2);
  std::discrete_distribution<size_t> leaf(area.begin(), area.end());
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Sensor> sensors;
  std::vector<const HierarchicalElement*> elements;
  for (int i = 0; i < kPoints; ++i) {
    elements.push_back(&solution.elements[leaf(rng)]);
    const HierarchicalElement& at = *elements.back();
    const double u = unit(rng), v = unit(rng);  // parallelograms all
    sensors.push_back(
        {at.origin + u * at.edge_u + v * at.edge_v, scene.facets[static_cast<size_t>(at.facet)].Normal()});
  }
  LightTracerOptions options;
  options.paths_per_sensor = 2048;
  const TracedIlluminance truth = TraceIlluminance(scene, rays, {lamp}, AlbedoOf(scene), sensors, options);
  double square = 0, sum = 0, direct_square = 0, direct_sum = 0;
  int free = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double direct_lx = truth.direct(i, 0), indirect_lx = truth.indirect(i, 0);
    if (direct_lx + indirect_lx == 0) continue;  // inside a solid
    ++free;
    const HierarchicalElement& element = *elements[static_cast<size_t>(i)];
    const double direct_difference = element.direct_lx - direct_lx;
    const double difference = element.illuminance_lx - direct_lx - indirect_lx;
    const double direct_noise = std::pow(truth.direct_sigma(i, 0), 2);
    direct_square += direct_difference * direct_difference - direct_noise;
    direct_sum += direct_difference;
    square += difference * difference - direct_noise - std::pow(truth.indirect_sigma(i, 0), 2);
    sum += difference;
  }
  const double percent = 100 / solution.mean_illuminance_lx;
  state.counters["measured"] = percent * std::sqrt(std::max(0.0, square / free));
  state.counters["bias"] = percent * sum / free;
  state.counters["direct"] = percent * std::sqrt(std::max(0.0, direct_square / free));
  state.counters["direct_bias"] = percent * direct_sum / free;
}

// Of all threads: the machine may be shared.
double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void Solve(benchmark::State& state, const Scene& scene, double error_percent, bool compare) {
  const RayScene rays(scene);
  const Luminaire lamp = CeilingPanel();
  HierarchicalOptions options;
  options.error_percent = error_percent;
  options.min_element_m = 0.002;
  HierarchicalSolution solution;
  const double before_s = CpuSeconds();
  for (auto _ : state) {
    solution =
        SolveHierarchical(scene, rays, AlbedoOf(scene), DirectLightOf(rays, lamp, error_percent), options);
  }
  state.counters["cpu_s"] = CpuSeconds() - before_s;
  Report(state, solution);
  state.counters["facets"] = static_cast<double>(scene.facets.size());
  if (compare) CompareWithTracer(state, scene, rays, lamp, solution);
}

void AskedError(benchmark::State& state) {
  Solve(state, MakeScene(state.range(0)), 0.1 * static_cast<double>(state.range(1)), true);
}
BENCHMARK(AskedError)
    ->ArgsProduct({{kEmpty, kPartition, kFurnished, kLegs}, {200, 100, 50}})
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

void Clutter(benchmark::State& state) {
  Scene scene = EmptyRoom();
  AddBoxes(scene, state.range(0), 1);
  Solve(state, scene, 20, true);
}
BENCHMARK(Clutter)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

void Detail(benchmark::State& state) {
  Scene scene = EmptyRoom();
  AddBoxes(scene, state.range(0), std::sqrt(1000.0 / static_cast<double>(state.range(0))));
  Solve(state, scene, 20, true);
}
BENCHMARK(Detail)
    ->RangeMultiplier(10)
    ->Range(160, 160000)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

void Pairs(benchmark::State& state) {
  LitScene lit;
  lit.scene = EmptyRoom();
  AddBoxes(lit.scene, state.range(0), std::sqrt(1000.0 / static_cast<double>(state.range(0))));
  lit.luminaires = {CeilingPanel()};
  lit.luminaires[0].flux_lm = 1;
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
