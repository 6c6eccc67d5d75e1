// Every radiosity solver on the office: time to 0.1 % of the illuminance, passes and error bound. Arguments:
// patch size in mm, columns. And the product of the coupling with one column against a plain read of the same
// bytes, which is the speed limit of all iterative solvers.
//   build/release/tests/benchmarks/solver_benchmark
#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>

#include "forward/factors/form_factors.h"
#include "forward/light/room.h"
#include "forward/mesh/mesh_file.h"
#include "forward/radiosity/internal/sparse_transport.h"
#include "forward/radiosity/solvers.h"
#include "forward/room/scene.h"
#include "tests/paths.h"

namespace luxfit {
namespace {

const Room& OfficeOf(int64_t patch_mm) {
  static std::map<int64_t, Room> rooms;
  const auto known = rooms.find(patch_mm);
  if (known != rooms.end()) return known->second;
  RoomOptions options;
  options.patches.patch_size_m = static_cast<double>(patch_mm) * 1e-3;
  options.patches.element_size_m = std::min(0.1, options.patches.patch_size_m);
  options.form_factors.rays_per_element = 64;
  return rooms.emplace(patch_mm, MakeRoom(ReadScene(LUXFIT_FIXTURES "/office/room.obj"), options))
      .first->second;
}

// Light on the floor below, at a different place in each column.
Eigen::MatrixXf Spots(const Patches& patches, Eigen::Index columns) {
  Eigen::MatrixXf direct(static_cast<Eigen::Index>(patches.patches.size()), columns);
  for (size_t i = 0; i < patches.patches.size(); ++i) {
    for (Eigen::Index c = 0; c < columns; ++c) {
      const Eigen::Vector3d lamp(0.5 + std::fmod(1.7 * static_cast<double>(c), 5), 2, 2.7);
      direct(static_cast<Eigen::Index>(i), c) =
          static_cast<float>(100 / (0.2 + (patches.patches[i].center - lamp).squaredNorm()));
    }
  }
  return direct;
}

Eigen::VectorXd HalfAlbedo(const Room& room) {
  return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(room.scene.materials.size()), 0.6);
}

void Report(benchmark::State& state, const RadiositySolution& solution, size_t patches) {
  state.counters["patches"] = static_cast<double>(patches);
  state.counters["iterations"] = solution.iterations;
  state.counters["residual"] = solution.residual;
  state.counters["error_percent"] = solution.error_percent;
  if (!solution.converged) state.SkipWithError(solution.message.c_str());
}

void Solve(benchmark::State& state, RadiositySolver solver) {
  const Room& room = OfficeOf(state.range(0));
  const Eigen::MatrixXf direct = Spots(room.patches, state.range(1));
  RadiositySolverOptions options;
  options.solver = solver;
  options.bounces = 20;
  RadiositySolution solution;
  for (auto _ : state) solution = SolveRadiosity(room.transport, HalfAlbedo(room), direct, options);
  Report(state, solution, room.patches.patches.size());
}
void SizesAndColumns(benchmark::internal::Benchmark* run) {
  run->Unit(benchmark::kMillisecond)->UseRealTime()->ArgsProduct({{400, 200, 120}, {1, 10, 50}});
}
BENCHMARK_CAPTURE(Solve, lu, RadiositySolver::kLu)->Apply(SizesAndColumns);
BENCHMARK_CAPTURE(Solve, cholesky, RadiositySolver::kCholesky)->Apply(SizesAndColumns);
BENCHMARK_CAPTURE(Solve, jacobi, RadiositySolver::kJacobi)->Apply(SizesAndColumns);
BENCHMARK_CAPTURE(Solve, gauss_seidel, RadiositySolver::kGaussSeidel)->Apply(SizesAndColumns);
BENCHMARK_CAPTURE(Solve, neumann, RadiositySolver::kNeumann)->Apply(SizesAndColumns);
BENCHMARK_CAPTURE(Solve, shooting, RadiositySolver::kShooting)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ArgsProduct({{400, 200, 120}, {1}});  // tens of thousands of shots a column
BENCHMARK_CAPTURE(Solve, conjugate_gradient, RadiositySolver::kConjugateGradient)->Apply(SizesAndColumns);
BENCHMARK_CAPTURE(Solve, bicgstab, RadiositySolver::kBicgstab)->Apply(SizesAndColumns);
BENCHMARK_CAPTURE(Solve, auto, RadiositySolver::kAuto) -> Apply(SizesAndColumns);

// Coupling stored sparsely, patches of one element; the time is that of the solution alone.
void SolveSparse(benchmark::State& state) {
  const Scene scene = ReadScene(LUXFIT_FIXTURES "/office/room.obj");
  const RayScene rays(scene);
  const double size_m = static_cast<double>(state.range(0)) * 1e-3;
  const Patches patches = Subdivide(scene, rays, {size_m, size_m});
  const auto start = std::chrono::steady_clock::now();
  const SparseTransport transport(rays, patches, {static_cast<int>(state.range(1))});
  state.counters["make_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  state.counters["store_MB"] = 8e-6 * static_cast<double>(transport.pair_count());
  const Eigen::VectorXd albedo =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(scene.materials.size()), 0.6);
  const Eigen::MatrixXf direct = Spots(patches, 1);
  RadiositySolution solution;
  for (auto _ : state)
    solution = SolveRadiosity(transport, PatchAreas(patches), PatchMaterials(patches), albedo, direct);
  Report(state, solution, patches.patches.size());
}
BENCHMARK(SolveSparse)
    ->Args({30, 128})
    ->Args({10, 64})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

double SecondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Reads all bytes on all cores: a search for a byte that is not there, for which libc has vector code for
// every processor, as BLAS has for the product.
bool ReadAll(const FormFactorMatrix& matrix) {
  return tbb::parallel_reduce(
      tbb::blocked_range<Eigen::Index>(0, matrix.rows(), 64), false,
      [&](const tbb::blocked_range<Eigen::Index>& rows, bool found) {
        const size_t bytes = sizeof(float) * rows.size() * static_cast<size_t>(matrix.cols());
        return found || std::memchr(matrix.row(rows.begin()).data(), 0, bytes) != nullptr;
      },
      std::logical_or<>());
}

void ProductAgainstRead(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  const FormFactorMatrix matrix = FormFactorMatrix::Constant(n, n, 1e-4f);  // no byte is 0
  const Eigen::MatrixXf x = Eigen::MatrixXf::Ones(n, 1);
  // The best of each, in turns: other processes only ever add.
  double product_s = 1e9, read_s = 1e9;
  for (auto _ : state) {
    product_s = std::min(product_s, SecondsOf([&] { benchmark::DoNotOptimize(Product(matrix, x)); }));
    read_s = std::min(read_s, SecondsOf([&] { benchmark::DoNotOptimize(ReadAll(matrix)); }));
  }
  const double gigabytes = 4e-9 * static_cast<double>(n) * static_cast<double>(n);
  state.counters["product_GB/s"] = gigabytes / product_s;
  state.counters["read_GB/s"] = gigabytes / read_s;
  state.counters["ratio"] = read_s / product_s;
}
BENCHMARK(ProductAgainstRead)
    ->Arg(4000)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(30);

}  // namespace
}  // namespace luxfit
