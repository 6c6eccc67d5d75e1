// The inversion from observations on, and what its derivatives save.
//
// WholeFit is all that `luxfit fit` does after the photos were observed, with its stages as counters.
// AnalyticFit and FiniteDifferenceFit solve the same problem from the same start, 10 cm and 20 % off:
// position and flux of every luminaire, all reflectances, the camera's scale. The first is the fit's own; the
// second is Ceres at its default tolerances with finite differences (forward), each a full
// solve: visibility, radiosity, gather.
// `off_mm` is the worst luminaire's distance from where the whole fit puts it.
#include <benchmark/benchmark.h>
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/stages/prepared_session.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/model/internal/light_model.h"
#include "tests/paths.h"

namespace luxfit {
namespace {

// Another session than the fixture may be given: LUXFIT_BENCHMARK_SESSION=office/session.toml.
const PreparedSession& Prepared() {
  static const PreparedSession prepared = [] {
    const char* given = std::getenv("LUXFIT_BENCHMARK_SESSION");
    RunContext context;
    context.is_quiet = true;
    context.out = (std::filesystem::temp_directory_path() / "luxfit_fit_benchmark").string();
    std::filesystem::create_directories(context.out + "/stages");
    return PrepareSession(
        ReadSession(given != nullptr ? given : std::string(LUXFIT_FIXTURES) + "/office/session.toml"),
        context);
  }();
  return prepared;
}

void WholeFit(benchmark::State& state) {
  const PreparedSession& prepared = Prepared();
  RunContext context;
  for ([[maybe_unused]] auto _ : state) {
    RunContext own;
    own.is_quiet = true;
    own.out = (std::filesystem::temp_directory_path() / "luxfit_fit_benchmark").string();
    benchmark::DoNotOptimize(
        FitSession(prepared.session, prepared.linearized, prepared.room, prepared.observed, own));
    context = own;
  }
  state.counters["observations"] = static_cast<double>(prepared.observed.observations.size());
  for (const char* stage : {"guess", "choose", "refine"}) state.counters[stage] = context.timing_s[stage];
}

// What both start from: the whole fit's models, moved.
struct Start {
  LightData data;
  LightState state;
  std::vector<Eigen::Vector3d> expected;
};

const Start& Moved() {
  static const Start start = [] {
    const PreparedSession& prepared = Prepared();
    RunContext context;
    context.is_quiet = true;
    context.out = (std::filesystem::temp_directory_path() / "luxfit_fit_benchmark").string();
    const RoomFit fitted =
        FitSession(prepared.session, prepared.linearized, prepared.room, prepared.observed, context);
    Start moved{fitted.data, fitted.fit.state, {}};
    for (size_t k = 0; k < moved.state.luminaires.size(); ++k) {
      Luminaire& luminaire = moved.state.luminaires[k];
      moved.expected.push_back(luminaire.position);
      moved.state.free[k] = {true, true, false, false, false, false, 0, 0};
      luminaire.position += Eigen::Vector3d(k % 2 == 0 ? 0.1 : -0.1, k % 4 < 2 ? 0.1 : -0.1, -0.1);
      luminaire.flux_lm *= k % 2 == 0 ? 1.2 : 0.8;
    }
    moved.state.albedo *= 0.9;
    return moved;
  }();
  return start;
}

double WorstOffM(const LightState& state) {
  double worst = 0;
  for (size_t k = 0; k < state.luminaires.size(); ++k)
    worst = std::max(worst, (state.luminaires[k].position - Moved().expected[k]).norm());
  return worst;
}

void AnalyticFit(benchmark::State& state) {
  const Start& start = Moved();
  FitLuminairesOptions options;
  options.covariance = false;
  double off_m = 0;
  for ([[maybe_unused]] auto _ : state)
    off_m = WorstOffM(FitLuminaires(Prepared().room, start.data, start.state, {}, options).state);
  state.counters["off_mm"] = 1000 * off_m;
}

// All that the model predicts, from nothing but geometry; Cauchy's loss as the fit has it.
class FullSolve {
 public:
  explicit FullSolve(const Start& start)
      : start_(start), parameters_(FreeParameters(Prepared().room, start.state)) {}

  bool operator()(double const* const* blocks, double* residuals) const {
    const Eigen::Map<const Eigen::VectorXd> x(blocks[0], static_cast<Eigen::Index>(parameters_.size()));
    const LightState state = WithParameters(start_.state, parameters_, x);
    LightModel model(Prepared().room, start_.data);
    model.FreezeVisibility(state);
    const Prediction prediction = model.Predict(state, {}, false);
    constexpr double kRelativeSigma = 0.01, kRobustSigmas = 3;
    for (size_t i = 0; i < start_.data.observations.size(); ++i) {
      const Observation& o = start_.data.observations[i];
      const double sigma = std::hypot(std::sqrt(o.variance), kRelativeSigma * o.relative_luminance);
      const double z =
          (prediction.value[static_cast<Eigen::Index>(i)] - o.relative_luminance) / sigma / kRobustSigmas;
      residuals[i] = std::copysign(kRobustSigmas * std::sqrt(std::log1p(z * z)), z);
    }
    for (size_t i = 0; i < start_.data.readings.size(); ++i) {
      const Reading& reading = start_.data.readings[i];
      const size_t row = start_.data.observations.size() + i;
      residuals[row] =
          reading.used
              ? (prediction.value[static_cast<Eigen::Index>(row)] - reading.illuminance_lx) / reading.sigma_lx
              : 0;
    }
    return true;
  }

  const std::vector<Parameter>& parameters() const { return parameters_; }

 private:
  const Start& start_;
  std::vector<Parameter> parameters_;
};

void FiniteDifferenceFit(benchmark::State& state) {
  const Start& start = Moved();
  double off_m = 0, iterations = 0;
  for ([[maybe_unused]] auto _ : state) {
    auto* solve = new FullSolve(start);
    const std::vector<Parameter> parameters = solve->parameters();
    Eigen::VectorXd x = PackParameters(start.state, parameters);
    auto* cost = new ceres::DynamicNumericDiffCostFunction<FullSolve, ceres::FORWARD>(solve);
    cost->AddParameterBlock(static_cast<int>(x.size()));
    cost->SetNumResiduals(static_cast<int>(start.data.observations.size() + start.data.readings.size()));
    ceres::Problem problem;
    problem.AddResidualBlock(cost, nullptr, x.data());
    for (size_t i = 0; i < parameters.size(); ++i) {
      problem.SetParameterLowerBound(x.data(), static_cast<int>(i), parameters[i].lower);
      problem.SetParameterUpperBound(x.data(), static_cast<int>(i), parameters[i].upper);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    off_m = WorstOffM(WithParameters(start.state, parameters, x));
    iterations = static_cast<double>(summary.iterations.size());
  }
  state.counters["off_mm"] = 1000 * off_m;
  state.counters["iterations"] = iterations;
}

}  // namespace
}  // namespace luxfit

BENCHMARK(luxfit::WholeFit)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK(luxfit::AnalyticFit)->Unit(benchmark::kSecond)->UseRealTime();
BENCHMARK(luxfit::FiniteDifferenceFit)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);
