// Form factors: rays against bare Embree, the default method against its rivals at equal error, one box with
// an occluder.
//   build/release/tests/benchmarks/form_factor_benchmark
//
// Counters: `rate_of_bare` rays per second over those of the same number of cosine-distributed rays given to
// Embree ready-made, in this run; `error` of the illuminance that a smooth exitance gives, root mean square
// over the elements; `row_sum_error` largest |1 - sum|; `before` its root mean square before closure is
// enforced.
#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "forward/factors/form_factors.h"
#include "forward/mesh/mesh_file.h"
#include "forward/room/internal/embree_queries.h"
#include "forward/room/scene.h"
#include "tests/paths.h"
#include "tests/support/scenes.h"

namespace luxfit {
namespace {

struct Ready {
  Scene scene;
  RayScene rays;
  Patches patches;
};

Ready MakeReady(Scene scene, const PatchesOptions& options) {
  RayScene rays(scene);
  Patches patches = Subdivide(scene, rays, options);
  return {std::move(scene), std::move(rays), std::move(patches)};
}

Scene Office() { return ReadScene(LUXFIT_FIXTURES "/office/room.obj"); }

Scene BoxWithOccluder() {
  Scene scene = support::ClosedRoom({1, 1, 1});
  support::AddBox(scene, {Eigen::Vector3d(0.35, 0.35, 0.35), Eigen::Vector3d(0.65, 0.65, 0.65)},
                  support::Facing::kOutward, {"box"});
  return scene;
}

double NowS() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Bare Embree: the scene built anew, its rays made beforehand in its own packets.
class BareEmbree {
 public:
  explicit BareEmbree(const Ready& room, int rays_per_element)
      : device_(rtcNewDevice("")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry quads = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
    const size_t n = room.scene.facets.size();
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        quads, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * n));
    auto* index = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(quads, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), n));
    for (unsigned k = 0; k < 4 * n; ++k) index[k] = k;
    for (const Facet& facet : room.scene.facets) {
      for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        const Eigen::Vector3f p = facet.PointAt(u, v).cast<float>();
        for (int axis = 0; axis < 3; ++axis) *vertices++ = p[axis];
      }
    }
    rtcCommitGeometry(quads);
    rtcAttachGeometry(scene_, quads);
    rtcReleaseGeometry(quads);
    rtcCommitScene(scene_);
    MakeRays(room, rays_per_element);
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  double MraysPerS() {
    const double start = NowS();
    tbb::parallel_for(tbb::blocked_range<size_t>(0, packets_.size(), 256),
                      [&](const tbb::blocked_range<size_t>& range) {
                        alignas(32) int valid[8];
                        std::fill(valid, valid + 8, -1);
                        for (size_t k = range.begin(); k < range.end(); ++k) {
                          RTCRayHit8 query = packets_[k];
                          Intersect(scene_, valid, query);
                          benchmark::DoNotOptimize(query.hit.primID[0]);
                        }
                      });
    return 8e-6 * static_cast<double>(packets_.size()) / (NowS() - start);
  }

 private:
  void MakeRays(const Ready& room, int rays_per_element) {
    std::mt19937 rng(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const Element& element : room.patches.elements) {
      const Eigen::Vector3d t = element.normal.unitOrthogonal(), b = element.normal.cross(t);
      for (int first = 0; first < rays_per_element; first += 8) {
        RTCRayHit8 query{};
        for (int k = 0; k < 8; ++k) {
          const double s = uniform(rng), angle = 6.283185307 * uniform(rng), radius = std::sqrt(s);
          const Eigen::Vector3f from =
              LiftedOff(element.origin + uniform(rng) * element.edge_u + uniform(rng) * element.edge_v,
                        element.normal)
                  .cast<float>();
          const Eigen::Vector3f d = (radius * std::cos(angle) * t + radius * std::sin(angle) * b +
                                     std::sqrt(1 - s) * element.normal)
                                        .cast<float>();
          query.ray.org_x[k] = from.x();
          query.ray.org_y[k] = from.y();
          query.ray.org_z[k] = from.z();
          query.ray.dir_x[k] = d.x();
          query.ray.dir_y[k] = d.y();
          query.ray.dir_z[k] = d.z();
          query.ray.tfar[k] = std::numeric_limits<float>::infinity();
          query.ray.mask[k] = std::numeric_limits<unsigned>::max();
          query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
          query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
        packets_.push_back(query);
      }
    }
  }

  RTCDevice device_;
  RTCScene scene_;
  std::vector<RTCRayHit8> packets_;
};

void RaysAgainstBareEmbree(benchmark::State& state) {
  const Ready room = MakeReady(Office(), {0.4, 0.1});
  const int rays_per_element = static_cast<int>(state.range(0));
  BareEmbree bare(room, rays_per_element);
  // Argument: rays an element. The matrix that they fill is written whichever their number. Turn by turn, so
  // that a busy machine slows both; the best of each counts.
  double best_bare = 0, best = 0;
  for (auto _ : state) {
    best_bare = std::max(best_bare, bare.MraysPerS());
    const double start = NowS();
    const FormFactors factors =
        ComputeFormFactors(room.rays, room.patches, {rays_per_element, FormFactorMethod::kMalley});
    best = std::max(best, 1e-6 * static_cast<double>(factors.rays) / (NowS() - start));
  }
  state.counters["Mray/s"] = best;
  state.counters["bare_Mray/s"] = best_bare;
  state.counters["rate_of_bare"] = best / best_bare;
}
BENCHMARK(RaysAgainstBareEmbree)
    ->Arg(64)
    ->Arg(256)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(15)
    ->UseRealTime();

double IlluminanceError(const Patches& patches, const FormFactorMatrix& a, const FormFactorMatrix& b) {
  Eigen::VectorXf exitance(static_cast<Eigen::Index>(patches.patches.size()));
  for (size_t j = 0; j < patches.patches.size(); ++j) {
    const Eigen::Vector3d& c = patches.patches[j].center;
    exitance[static_cast<Eigen::Index>(j)] =
        static_cast<float>(1 + std::sin(1.3 * c.x() + 0.7 * c.y() - c.z()));
  }
  return ((a - b) * exitance).norm() / (b * exitance).norm();
}

// Argument: method, rays an element, on the office with patches of 0.4 m and elements of 0.2 m.
void AtEqualError(benchmark::State& state) {
  static const Ready room = MakeReady(Office(), {0.4, 0.2});
  static const FormFactorMatrix reference =
      ComputeFormFactors(room.rays, room.patches, {65536, FormFactorMethod::kMalley}).element_to_patch;
  const FormFactorOptions options{static_cast<int>(state.range(1)),
                                  static_cast<FormFactorMethod>(state.range(0))};
  FormFactors factors;
  for (auto _ : state) factors = ComputeFormFactors(room.rays, room.patches, options);
  state.SetLabel(ToString(options.method));
  state.counters["error_%"] = 100 * IlluminanceError(room.patches, factors.element_to_patch, reference);
}
BENCHMARK(AtEqualError)
    ->Args({static_cast<int>(FormFactorMethod::kHybrid), 64})
    ->Args({static_cast<int>(FormFactorMethod::kHybrid), 256})
    ->Args({static_cast<int>(FormFactorMethod::kMalley), 256})
    ->Args({static_cast<int>(FormFactorMethod::kMalley), 4096})
    ->Args({static_cast<int>(FormFactorMethod::kIsocell), 1024})
    ->Args({static_cast<int>(FormFactorMethod::kMonteCarlo), 256})
    ->Args({static_cast<int>(FormFactorMethod::kMonteCarlo), 4096})
    ->Args({static_cast<int>(FormFactorMethod::kMonteCarlo), 32768})
    ->Args({static_cast<int>(FormFactorMethod::kHemicube), 768})
    ->Args({static_cast<int>(FormFactorMethod::kHemicube), 12288})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3)
    ->UseRealTime();

// View3D, an adaptive form-factor program, took 23.5 s for 5400 patches of such a box.
void BoxWithOneOccluder(benchmark::State& state) {
  const double size = 1e-4 * static_cast<double>(state.range(0));
  const Ready box = MakeReady(BoxWithOccluder(), {size, size});
  FormFactors factors;
  for (auto _ : state) factors = ComputeFormFactors(box.rays, box.patches);
  state.counters["patches"] = static_cast<double>(box.patches.patches.size());
  state.counters["row_sum_error"] = (factors.element_to_patch.rowwise().sum().array() - 1).abs().maxCoeff();
  state.counters["before"] = factors.closure_error;
}
BENCHMARK(BoxWithOneOccluder)
    ->Arg(1000)
    ->Arg(500)
    ->Arg(345)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3)
    ->UseRealTime();

}  // namespace
}  // namespace luxfit
