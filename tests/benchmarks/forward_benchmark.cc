// What the forward model costs on the office: form factors, one factorisation with its solves, one prediction
// with and without derivatives. Argument: patch size in mm. And direct light alone, values and derivatives of
// one luminaire at places all over a room of 4 m.
//   build/release/tests/benchmarks/forward_benchmark
#include <benchmark/benchmark.h>

#include <memory>
#include <numeric>
#include <random>

#include "forward/direct/direct_light.h"
#include "forward/light/illuminance.h"
#include "forward/light/room.h"
#include "forward/luminaire/luminaire_parts.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/scene.h"
#include "tests/paths.h"

namespace luxfit {
namespace {

Scene Office() { return ReadScene(LUXFIT_FIXTURES "/office/room.obj"); }

RoomOptions WithPatchSize(int64_t millimetres) {
  RoomOptions options;
  options.patches.patch_size_m = static_cast<double>(millimetres) * 1e-3;
  return options;
}

std::vector<Luminaire> FourLuminaires() {
  std::vector<Luminaire> luminaires(4);
  const Eigen::Vector3d places[] = {{1.5, 2.0, 2.79}, {4.2, 2.6, 2.79}, {2.9, 0.7, 2.78}, {5.2, 1.6, 2.78}};
  for (size_t k = 0; k < luminaires.size(); ++k) luminaires[k].position = places[k];
  return luminaires;
}

void FormFactors(benchmark::State& state) {
  const Scene scene = Office();
  const RayScene rays(scene);
  const Patches patches = Subdivide(scene, rays, WithPatchSize(state.range(0)).patches);
  for (auto _ : state) benchmark::DoNotOptimize(ComputeFormFactors(rays, patches));
  state.counters["patches"] = static_cast<double>(patches.patches.size());
  state.counters["Mray/s"] = benchmark::Counter(256e-6 * static_cast<double>(patches.elements.size()),
                                                benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(FormFactors)->Arg(600)->Arg(400)->Arg(200)->Unit(benchmark::kMillisecond)->UseRealTime();

void FactorAndSolve(benchmark::State& state) {
  const Room room = MakeRoom(Office(), WithPatchSize(state.range(0)));
  const Eigen::VectorXd albedo =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(room.scene.materials.size()), 0.5);
  const Eigen::MatrixXf direct =
      Eigen::MatrixXf::Ones(static_cast<Eigen::Index>(room.patches.patches.size()), 50);
  for (auto _ : state) benchmark::DoNotOptimize(Transport(room.transport, albedo).Exitance(direct));
}
BENCHMARK(FactorAndSolve)->Arg(600)->Arg(400)->Arg(200)->Unit(benchmark::kMillisecond)->UseRealTime();

void Predict(benchmark::State& state, bool derivatives) {
  const Room room = MakeRoom(Office(), WithPatchSize(state.range(0)));
  std::vector<int> elements(room.patches.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  const Receivers receivers = MakeReceivers(room, elements, {});
  const std::vector<Luminaire> luminaires = FourLuminaires();
  const LuminaireVisibility visibility = ComputeVisibility(room, receivers, luminaires);
  const Eigen::VectorXd albedo =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(room.scene.materials.size()), 0.5);
  DerivativeRequest request;
  if (derivatives) {
    for (int k = 0; k < 4; ++k) {
      for (const LuminaireQuantity q :
           {LuminaireQuantity::kPositionX, LuminaireQuantity::kPositionY, LuminaireQuantity::kPositionZ}) {
        request.parameters.push_back({k, q});
      }
    }
    for (int m = 0; m < static_cast<int>(room.scene.materials.size()); ++m) request.materials.push_back(m);
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(ComputeIlluminance(room, receivers, visibility, luminaires, albedo, request));
  }
  state.counters["parameters"] = static_cast<double>(request.parameters.size() + request.materials.size());
}
BENCHMARK_CAPTURE(Predict, values, false)
    ->Arg(600)
    ->Arg(400)
    ->Arg(200)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(Predict, with_derivatives, true)
    ->Arg(600)
    ->Arg(400)
    ->Arg(200)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// On the floor and on a wall.
void Direct(benchmark::State& state, LuminaireShape shape, Distribution distribution,
            const Eigen::Vector2d& size_m = {0.6, 0.6}) {
  Luminaire luminaire;
  luminaire.position = {0.3, -0.2, 2.5};
  luminaire.aim = Eigen::Vector3d(0.1, 0.05, -1).normalized();
  luminaire.shape = shape;
  luminaire.distribution = distribution;
  luminaire.size_m = size_m;
  luminaire.table = std::make_shared<IntensityTable>(TwoSidedTable(0.3));
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> across(-2, 2), height(0, 2.8);
  const Eigen::Vector3d up(0, 0, 1), inwards(-1, 0, 0);
  std::vector<Sensor> places;
  for (int k = 0; k < 1000; ++k) {
    places.push_back({{across(rng), across(rng), 0}, up, {}});
    places.push_back({{2, across(rng), height(rng)}, inwards, {}});
  }
  for (auto _ : state) {
    DirectIlluminance sum;
    for (const Sensor& place : places)
      sum.AddScaled(1, DirectIlluminancePerLumen(luminaire, place.position, place.normal));
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(places.size()));
}
BENCHMARK_CAPTURE(Direct, point, LuminaireShape::kPoint, Distribution::kLambertian);
BENCHMARK_CAPTURE(Direct, rectangle, LuminaireShape::kRectangle, Distribution::kLambertian);
BENCHMARK_CAPTURE(Direct, disc, LuminaireShape::kDisc, Distribution::kLambertian);
BENCHMARK_CAPTURE(Direct, rectangle_by_sum, LuminaireShape::kRectangle, Distribution::kCosinePower);
BENCHMARK_CAPTURE(Direct, disc_by_sum, LuminaireShape::kDisc, Distribution::kCosinePower);
BENCHMARK_CAPTURE(Direct, rectangle_of_table, LuminaireShape::kRectangle, Distribution::kMeasured);
BENCHMARK_CAPTURE(Direct, strip_of_table, LuminaireShape::kRectangle, Distribution::kMeasured,
                  Eigen::Vector2d(2.4, 0.1));

}  // namespace
}  // namespace luxfit
