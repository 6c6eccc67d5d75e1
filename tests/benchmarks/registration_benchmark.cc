// Registration after detection: 100 views of 12 tags, and joint problems of views and points.
//
// TagsAndPoints and ColmapBundleAdjuster have the same views and points: compare the former's CPU with the
// latter's time.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include "calib/register/registration.h"
#include "tests/support/calib/colmap_files.h"
#include "tests/support/calib/feature_room.h"

namespace luxfit {
namespace {

struct Problem {
  support::FeatureRoom room;
  std::vector<ViewDetections> detections;
  FeatureModel features;
};

// Views that see about twelve tags each: 40 on the walls.
Problem MakeProblem(int views, int points) {
  std::mt19937_64 rng(1);
  Problem problem;
  problem.room = support::MakeFeatureRoom(views, 40, points, rng);
  double tags = 0;
  for (std::size_t v = 0; v < problem.room.poses.size(); ++v) {
    problem.detections.push_back(support::DetectTagsOf(problem.room, problem.room.tags, v, 0.05, rng));
    if (problem.detections.back().tags.size() > 12) problem.detections.back().tags.resize(12);
    tags += static_cast<double>(problem.detections.back().tags.size());
  }
  problem.features = support::FeaturesOfRoom(problem.room, {0.3, 0, 0.005}, support::AnySimilarity(), rng);
  return problem;
}

void Report(benchmark::State& state, const Problem& problem, const Registration& registration) {
  double tags = 0, observations = 0, error_m = 0;
  for (const ViewDetections& view : problem.detections) tags += static_cast<double>(view.tags.size());
  for (const FeatureTrack& track : problem.features.tracks)
    observations += static_cast<double>(track.seen.size());
  for (std::size_t i = 0; i < registration.views.size(); ++i) {
    const auto v = static_cast<std::size_t>(std::stoi(registration.views[i].view.substr(1)));
    error_m += support::PoseError(registration.views[i], problem.room.poses[v]).tail<3>().norm() /
               static_cast<double>(registration.views.size());
  }
  state.counters["views"] = static_cast<double>(registration.views.size());
  state.counters["tags_a_view"] = tags / static_cast<double>(problem.detections.size());
  state.counters["observations"] = observations;
  state.counters["error_mm"] = 1000 * error_m;
}

void Tags(benchmark::State& state) {
  const Problem problem = MakeProblem(static_cast<int>(state.range(0)), 0);
  Registration registration;
  for (auto _ : state)
    registration = RegisterViews({problem.room.camera}, problem.room.tags, problem.detections);
  Report(state, problem, registration);
}
BENCHMARK(Tags)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);

void TagsAndPoints(benchmark::State& state) {
  const Problem problem = MakeProblem(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  Registration registration;
  for (auto _ : state) {
    registration =
        RegisterViews({problem.room.camera}, problem.room.tags, problem.detections, problem.features);
  }
  Report(state, problem, registration);
}
BENCHMARK(TagsAndPoints)
    ->Args({10, 1000})
    ->Args({30, 3000})
    ->Args({100, 3000})
    ->Unit(benchmark::kMillisecond);

double ChildrenCpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

// COLMAP's own adjustment of the same views and points; CPU time of the process, its reading and writing of
// text included.
void ColmapBundleAdjuster(benchmark::State& state) {
  namespace fs = std::filesystem;
  if (std::system("command -v colmap > /dev/null 2>&1") != 0) {
    state.SkipWithError("colmap is not installed");
    return;
  }
  const Problem problem = MakeProblem(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const fs::path folder = fs::temp_directory_path() / "luxfit_colmap_benchmark";
  support::WriteColmapModel(folder, problem.room.camera, problem.features);
  fs::create_directories(folder / "out");
  const std::string command =
      "colmap bundle_adjuster --input_path " + folder.string() + " --output_path " +
      (folder / "out").string() +
      " --BundleAdjustment.refine_focal_length 0 --BundleAdjustment.refine_extra_params 0"
      " > /dev/null 2>&1";
  for (auto _ : state) {
    const double before_s = ChildrenCpuSeconds();
    if (std::system(command.c_str()) != 0) state.SkipWithError("colmap bundle_adjuster failed");
    state.SetIterationTime(ChildrenCpuSeconds() - before_s);
  }
  fs::remove_all(folder);
}
BENCHMARK(ColmapBundleAdjuster)
    ->Args({10, 1000})
    ->Args({30, 3000})
    ->Args({100, 3000})
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();

}  // namespace
}  // namespace luxfit
