#include "apps/charts/chart_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "apps/text/seconds.h"
#include "forward/factors/form_factors.h"
#include "forward/light/light_tracer.h"
#include "forward/mesh/mesh_check.h"

namespace luxfit {
namespace {

// Returns the shortest time of up to five runs. No run follows once they have taken half a second together.
template <typename Run>
double BestTimeS(double first_s, const Run& run) {
  double best_s = first_s, spent_s = first_s;
  for (int i = 1; i < 5 && spent_s < 0.5; ++i) {
    const double start_s = NowS();
    run();
    const double time_s = NowS() - start_s;
    best_s = std::min(best_s, time_s);
    spent_s += time_s;
  }
  return best_s;
}

// Returns illuminance per lumen, colour by colour as ComputeColourIlluminance has it.
ChartReference Trace(const LitScene& lit, int paths_per_sensor) {
  const Scene scene = WithoutOverlaps(lit.scene);
  const RayScene rays(scene);
  ChartReference reference;
  reference.paths_per_sensor = paths_per_sensor;
  LightTracerOptions options;
  options.paths_per_sensor = paths_per_sensor;
  const auto rows = static_cast<Eigen::Index>(lit.sensors.size());
  const auto lamps = static_cast<Eigen::Index>(lit.luminaires.size());
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(rows, lamps);
  reference.lx_per_lm = variance;
  Eigen::Vector3d share = lit.channel_weights / lit.channel_weights.sum();
  for (int channel = 0; channel < 3; ++channel) {
    double weight = 0;
    for (int other = channel; other < 3; ++other) {
      if (lit.albedo_rgb.row(other) != lit.albedo_rgb.row(channel)) continue;
      weight += share[other];
      share[other] = 0;
    }
    if (weight == 0) continue;
    options.seed += 1;
    const TracedIlluminance traced = TraceIlluminance(
        scene, rays, lit.luminaires, lit.albedo_rgb.row(channel).transpose(), lit.sensors, options);
    reference.lx_per_lm += weight * (traced.direct + traced.indirect);
    variance += weight * weight *
                (traced.direct_sigma.array().square() + traced.indirect_sigma.array().square()).matrix();
  }
  reference.sigma_percent =
      RelativeRmsPercent(reference.lx_per_lm + variance.cwiseSqrt(), reference.lx_per_lm);
  return reference;
}

ChartReference TraceWithin(const LitScene& lit, double budget_s) {
  constexpr int kFirstPaths = 2048, kMostTimes = 256;
  const double start_s = NowS();
  ChartReference first = Trace(lit, kFirstPaths);
  const double times = budget_s / std::max(NowS() - start_s, 1e-6);
  if (times < 2) return first;
  return Trace(lit, kFirstPaths * static_cast<int>(std::min<double>(times, kMostTimes)));
}

// Holds one way to the form factors: the costly part, shared by all bounces and solvers.
struct Setup {
  FormFactorMethod method;
  int rays;
  double patch_size_m, element_size_m;
  bool adaptive;
  int rays_per_sensor;
  auto Tied() const {
    return std::tie(element_size_m, patch_size_m, rays, method, adaptive, rays_per_sensor);
  }
  bool operator<(const Setup& other) const { return Tied() < other.Tied(); }
};

class ChartMaker {
 public:
  ChartMaker(const LitScene& lit, double error_percent, double budget_s)
      : lit_(lit), error_percent_(error_percent), budget_s_(budget_s), end_s_(NowS() + budget_s) {
    for (Luminaire& luminaire : lit_.luminaires) luminaire.flux_lm = 1;
    for (Sensor& sensor : lit_.sensors) sensor.response = {};
    chart_.reference = TraceWithin(lit_, kReferenceShare * budget_s);
  }

  Chart Run() {
    MeasureAutomatic();
    SweepAskedErrors();
    if (chart_.points.front().patches > 0) {
      // The coarsest come first, because they predict the time of the others.
      const std::vector<double> sizes = Sizes();
      MeasureGrid(sizes.front());
      SweepFormFactors();
      for (size_t i = 1; i < sizes.size(); ++i) MeasureGrid(sizes[i]);
    }
    MarkFront(chart_.points);
    return std::move(chart_);
  }

 private:
  static constexpr double kReferenceShare = 0.2, kPointShare = 0.15;  // of the budget; for one point

  double ErrorOf(const ColourIlluminance& light) const {
    return RelativeRmsPercent(light.total.cast<double>(), chart_.reference.lx_per_lm);
  }

  static Setup SetupOf(const SceneLightOptions& options) {
    const PatchesOptions& patches = options.room.patches;
    return {options.room.form_factors.method,
            options.room.form_factors.rays_per_element,
            patches.patch_size_m,
            patches.element_size_m,
            patches.must_split != nullptr,
            options.rays_per_sensor};
  }

  // Times a prediction and completes its point.
  SceneLight Predict(const SceneLightOptions& options, ChartPoint& point) const {
    const double start_s = NowS();
    SceneLight prediction = ComputeSceneLight(lit_, options);
    point.time_s = BestTimeS(NowS() - start_s, [&] { ComputeSceneLight(lit_, options); });
    point.patches = static_cast<int>(prediction.room.patches.patches.size());
    point.solver = prediction.light.solver;
    point.error_percent = ErrorOf(prediction.light);
    return prediction;
  }

  static ChartPoint PointOf(const std::string& factor, const SceneLightOptions& options) {
    ChartPoint point;
    point.factor = factor;
    point.method = options.room.form_factors.method;
    point.rays = options.room.form_factors.rays_per_element;
    point.patch_size_m = options.room.patches.patch_size_m;
    point.element_size_m = options.room.patches.element_size_m;
    point.adaptive = options.room.patches.must_split != nullptr;
    point.solver = options.solver.solver;
    if (point.solver == RadiositySolver::kNeumann) point.bounces = options.solver.bounces;
    return point;
  }

  // Uniform patches whose elements are as small as those of the choice.
  double ChosenSizeM() const {
    const double ratio = PatchesOfSize(1).element_size_m;
    return chart_.choice.options.room.patches.element_size_m / ratio;
  }

  void MeasureAutomatic() {
    AccuracyOptions asked;
    asked.error_percent = error_percent_;
    const double start_s = NowS();
    chart_.choice = ChooseAccuracy(lit_, asked).choice;
    chart_.choosing_s = NowS() - start_s;
    const SceneLightOptions& options = chart_.choice.options;
    ChartPoint point = PointOf("automatic", options);
    const SceneLight prediction = Predict(options, point);
    point.estimated_error_percent = chart_.choice.estimated_error_percent;
    point.automatic = true;
    chart_.points.push_back(point);
    measured_[SetupOf(options)] = point;
    if (point.patches > 0) SweepSolvers(prediction, point);
  }

  // Uses the form factors of the automatic choice: only the time of the solution differs.
  void SweepSolvers(const SceneLight& prediction, const ChartPoint& automatic) {
    const RadiositySolverOptions chosen = chart_.choice.options.solver;
    const auto light_s = [&](const RadiositySolverOptions& options, ColourIlluminance& light) {
      const double start_s = NowS();
      light = Relight(lit_, prediction, options);
      return BestTimeS(NowS() - start_s, [&] { Relight(lit_, prediction, options); });
    };
    ColourIlluminance light;
    const double setup_s = std::max(0.0, automatic.time_s - light_s(chosen, light));
    const auto measure = [&](const std::string& factor, const RadiositySolverOptions& options) {
      ChartPoint point = automatic;
      point.factor = factor;
      point.automatic = false;
      point.estimated_error_percent.reset();
      point.time_s = setup_s + light_s(options, light);
      point.solver = light.solver;
      point.bounces.reset();
      if (light.solver == RadiositySolver::kNeumann) point.bounces = options.bounces;
      point.error_percent = ErrorOf(light);
      // The same point is not timed twice.
      if (point.solver == automatic.solver && point.bounces == automatic.bounces)
        point.time_s = automatic.time_s;
      chart_.points.push_back(point);
    };
    RadiositySolverOptions options = chosen;
    options.solver = RadiositySolver::kNeumann;
    for (const int bounces : {0, 1, 2, 3, 5, 8, 12, 20}) {
      options.bounces = bounces;
      measure("bounces", options);
    }
    for (const RadiositySolver solver :
         {RadiositySolver::kAuto, RadiositySolver::kLu, RadiositySolver::kCholesky, RadiositySolver::kJacobi,
          RadiositySolver::kGaussSeidel, RadiositySolver::kShooting, RadiositySolver::kConjugateGradient,
          RadiositySolver::kBicgstab}) {
      options.solver = solver;
      measure(solver == RadiositySolver::kAuto ? "bounces" : "solver", options);
    }
  }

  void SweepAskedErrors() {
    for (const double percent : {10.0, 5.0, 2.0, 1.0, 0.5}) {
      AccuracyOptions asked;
      asked.error_percent = percent;
      // A tenth of the error may ask for patches a quarter as large, 64 times the work.
      const double times = std::pow(std::max(1.0, error_percent_ / percent), 1.5);
      ChartPoint expected = PointOf("asked_error", chart_.choice.options);
      if (IsTooLong(expected, times * chart_.choosing_s)) continue;
      const AccuracyChoice choice = ChooseAccuracy(lit_, asked).choice;
      ChartPoint point = Measured("asked_error", choice.options);
      point.estimated_error_percent = choice.estimated_error_percent;
      chart_.points.push_back(point);
    }
  }

  ChartPoint Measured(const std::string& factor, const SceneLightOptions& options) {
    const Setup setup = SetupOf(options);
    const bool same_solver = options.solver.solver == chart_.choice.options.solver.solver &&
                             options.solver.bounces == chart_.choice.options.solver.bounces;
    const auto known = measured_.find(setup);
    ChartPoint point = PointOf(factor, options);
    if (known != measured_.end() && same_solver) {
      point = known->second;
      point.factor = factor;
      point.automatic = false;
      point.estimated_error_percent.reset();
      return point;
    }
    Predict(options, point);
    if (same_solver) measured_[setup] = point;
    return point;
  }

  bool IsTooLong(const ChartPoint& point, double expected_s) {
    if (NowS() + expected_s <= end_s_ && expected_s <= kPointShare * budget_s_) return false;
    chart_.skipped.push_back({point, expected_s});
    return true;
  }

  // Predicts the time from measured points: from fewer rays on the same patches, else from larger patches,
  // else from the automatic choice. Halving the patch size multiplies the pairs by 16, and the time of
  // methods that take rays by 2^2.5.
  double ExpectedS(const Setup& setup) const {
    if (measured_.count(setup) > 0) return 0;
    const bool pairwise = OpsOf(setup.method).by_pairs != nullptr;
    double by_rays_s = -1, by_size_s = -1;
    for (const auto& [known, point] : measured_) {
      if (known.method != setup.method) continue;
      const double rays = static_cast<double>(setup.rays) / known.rays;
      const double size = known.element_size_m / setup.element_size_m;
      // Among the pairs only the partly hidden ones take rays.
      if (pairwise && size == 1) by_rays_s = point.time_s * std::max(1.0, std::sqrt(rays));
      if (!pairwise && size == 1 && rays > 1) by_rays_s = point.time_s * rays;
      if (size > 1) by_size_s = point.time_s * std::pow(size, pairwise ? 4 : 2.5) * std::max(1.0, rays);
    }
    if (by_rays_s >= 0) return by_rays_s;
    if (by_size_s >= 0) return by_size_s;
    const ChartPoint& automatic = chart_.points.front();
    return automatic.time_s * std::pow(std::max(1.0, automatic.element_size_m / setup.element_size_m), 3) *
           std::max(1.0, static_cast<double>(setup.rays) / automatic.rays);
  }

  // Uses patches of one size, with everything else as chosen.
  void Measure(const std::string& factor, double patch_size_m, const FormFactorOptions& form_factors) {
    SceneLightOptions options = chart_.choice.options;
    options.room.patches = PatchesOfSize(patch_size_m);
    options.room.form_factors = form_factors;
    if (!IsTooLong(PointOf(factor, options), ExpectedS(SetupOf(options))))
      chart_.points.push_back(Measured(factor, options));
  }

  std::vector<int> Rays() const {
    std::vector<int> rays = {16, 64, 256, 1024};
    const int chosen = chart_.choice.options.room.form_factors.rays_per_element;
    if (std::count(rays.begin(), rays.end(), chosen) == 0) rays.push_back(chosen);
    std::sort(rays.begin(), rays.end());
    return rays;
  }

  // Ranges from the coarsest size that the choice tried to a quarter of the chosen one.
  std::vector<double> Sizes() const {
    std::vector<double> sizes;
    const double finest_m = ChosenSizeM() / 4;
    for (double size_m = chart_.choice.tried.front().patch_size_m; size_m > 0.99 * finest_m; size_m /= 2)
      sizes.push_back(size_m);
    return sizes;
  }

  void SweepFormFactors() {
    const FormFactorOptions chosen = chart_.choice.options.room.form_factors;
    for (const FormFactorOps& ops : FormFactorMethods())
      Measure("method", ChosenSizeM(), {chosen.rays_per_element, ops.method});
    for (const int rays : Rays()) Measure("rays", ChosenSizeM(), {rays, chosen.method});
    for (const double size_m : Sizes()) Measure("patch_size", size_m, chosen);
  }

  void MeasureGrid(double size_m) {
    for (const int rays : Rays()) {
      for (const FormFactorOps& ops : FormFactorMethods()) Measure("grid", size_m, {rays, ops.method});
    }
  }

  LitScene lit_;
  double error_percent_, budget_s_, end_s_;
  Chart chart_;
  std::map<Setup, ChartPoint> measured_;
};

}  // namespace

void MarkFront(std::vector<ChartPoint>& points) {
  constexpr double kSame = 0.01;
  const auto beats = [](const ChartPoint& other, const ChartPoint& point) {
    const double time = other.time_s / point.time_s, error = other.error_percent / point.error_percent;
    return time <= 1 + kSame && error <= 1 + kSame && (time < 1 - kSame || error < 1 - kSame);
  };
  for (ChartPoint& point : points) {
    point.on_front = std::none_of(points.begin(), points.end(),
                                  [&](const ChartPoint& other) { return beats(other, point); });
  }
}

Chart MeasureChart(const LitScene& lit, double error_percent, double budget_s) {
  return ChartMaker(lit, error_percent, budget_s).Run();
}

}  // namespace luxfit
