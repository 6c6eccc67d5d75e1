// Hierarchical radiosity: leaves, links, time, memory and error as the bound falls (FurnishedRoom) and as
// facets are added (Clutter). FurnishedRoom: percent x 10 that is asked for; error_vs_dense is the
// area-weighted rms difference from the dense solution (patches 0.2 m, elements 0.1 m, 1024 rays) at the
// leaves' centres, in percent of the mean: it holds the dense solution's own error at shadow edges too.
// Clutter: boxes in the room, 20 % asked for.
//   build/release/tests/benchmarks/hierarchical_benchmark
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <random>

#include "forward/hierarchical.h"
#include "forward/illuminance.h"
#include "forward/room.h"
#include "forward/shadowed_light.h"
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

// Boxes of 3 to 10 cm above the floor, turned about z, as many as asked for.
Scene RoomWithBoxes(int64_t count) {
  Scene scene = support::ClosedRoom({6, 4, 2.8}, {"wall", "wall", "wall", "wall", "floor", "ceiling"});
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int64_t i = 0; i < count; ++i) {
    const Eigen::Vector3d center(0.1 + 5.8 * unit(rng), 0.1 + 3.8 * unit(rng), 0.1 + 1.4 * unit(rng));
    const Eigen::Vector3d half =
        Eigen::Vector3d::Constant(0.015) + 0.035 * Eigen::Vector3d(unit(rng), unit(rng), unit(rng));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(unit(rng), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    Scene box;
    support::AddBox(box, {-half, half}, support::Facing::kOutward, {"box"});
    for (Facet facet : box.facets) {
      facet.origin = center + turn * facet.origin;
      facet.edge_u = turn * facet.edge_u;
      facet.edge_v = turn * facet.edge_v;
      facet.material = support::MaterialIndex(scene, "box");
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

DirectLight DirectLightOf(const RayScene& rays, const Luminaire& lamp) {
  return [&rays, &lamp](const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    return lamp.flux_lm * VisibleIlluminancePerLumen(rays, lamp, p, normal);
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

// Total illuminance of the dense solution, by element.
Eigen::VectorXd DenseLux(const Room& room, const Luminaire& lamp) {
  std::vector<int> elements(room.patches.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  const Receivers receivers = MakeReceivers(room, elements, {});
  const LuminaireVisibility visibility = ComputeVisibility(room, receivers, {lamp});
  return lamp.flux_lm * ComputeIlluminance(room, receivers, visibility, {lamp}, AlbedoOf(room.scene))
                            .total.col(0)
                            .cast<double>();
}

double ErrorVersusDense(const Room& room, const HierarchicalSolution& solution, const Luminaire& lamp) {
  const Eigen::VectorXd dense = DenseLux(room, lamp);
  double square = 0, area = 0;
  for (const HierarchicalElement& leaf : solution.elements) {
    const Facet& facet = room.scene.facets[static_cast<size_t>(leaf.facet)];  // rectangles all
    const Eigen::Vector3d d = leaf.center - facet.origin;
    const int element = room.patches.ElementAt(leaf.facet, d.dot(facet.edge_u) / facet.edge_u.squaredNorm(),
                                               d.dot(facet.edge_v) / facet.edge_v.squaredNorm());
    if (element < 0) continue;
    square += leaf.area_m2 * std::pow(leaf.illuminance_lx - dense[element], 2);
    area += leaf.area_m2;
  }
  return 100 * std::sqrt(square / area) / solution.mean_illuminance_lx;
}

void FurnishedRoom(benchmark::State& state) {
  Scene scene = RoomWithBoxes(0);
  support::AddBox(scene, {Eigen::Vector3d(0.6, 0.5, 0), Eigen::Vector3d(1.4, 1.5, 1.1)},
                  support::Facing::kOutward, {"box"});
  support::AddBox(scene, {Eigen::Vector3d(2.6, 1.0, 0.9), Eigen::Vector3d(3.3, 2.2, 1.0)},
                  support::Facing::kOutward, {"box"});
  RoomOptions room_options;
  room_options.patches.patch_size_m = 0.2;
  room_options.form_factors.rays_per_element = 1024;
  const Room room = MakeRoom(scene, room_options);
  const Luminaire lamp = CeilingPanel();
  HierarchicalOptions options;
  options.error_percent = 0.1 * static_cast<double>(state.range(0));
  options.min_element_m = 0.002;
  HierarchicalSolution solution;
  for (auto _ : state) {
    solution = SolveHierarchical(room.scene, room.rays, AlbedoOf(room.scene), DirectLightOf(room.rays, lamp),
                                 options);
  }
  Report(state, solution);
  state.counters["error_vs_dense"] = ErrorVersusDense(room, solution, lamp);
}
BENCHMARK(FurnishedRoom)
    ->Arg(200)
    ->Arg(100)
    ->Arg(50)
    ->Arg(25)
    ->Arg(15)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

void Clutter(benchmark::State& state) {
  const Scene scene = RoomWithBoxes(state.range(0));
  const RayScene rays(scene);
  const Luminaire lamp = CeilingPanel();
  HierarchicalOptions options;
  options.error_percent = 20;
  HierarchicalSolution solution;
  for (auto _ : state)
    solution = SolveHierarchical(scene, rays, AlbedoOf(scene), DirectLightOf(rays, lamp), options);
  Report(state, solution);
  state.counters["facets"] = static_cast<double>(scene.facets.size());
}
BENCHMARK(Clutter)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

}  // namespace
}  // namespace luxfit
