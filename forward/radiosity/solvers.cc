#include "forward/radiosity/solvers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "forward/radiosity/internal/dense.h"
#include "forward/radiosity/internal/linear_transport.h"
#include "forward/radiosity/internal/radiosity_system.h"

namespace luxfit {
namespace {

struct NamedSolver {
  RadiositySolver solver;
  const char* name;
};
constexpr std::array<NamedSolver, 9> kNames = {{{RadiositySolver::kAuto, "auto"},
                                                {RadiositySolver::kLu, "lu"},
                                                {RadiositySolver::kCholesky, "cholesky"},
                                                {RadiositySolver::kJacobi, "jacobi"},
                                                {RadiositySolver::kGaussSeidel, "gauss_seidel"},
                                                {RadiositySolver::kNeumann, "neumann"},
                                                {RadiositySolver::kShooting, "shooting"},
                                                {RadiositySolver::kConjugateGradient, "conjugate_gradient"},
                                                {RadiositySolver::kBicgstab, "bicgstab"}}};

void Check(Eigen::Index patches, const Eigen::VectorXf& area, const std::vector<int>& material,
           const Eigen::VectorXd& albedo, const Eigen::MatrixXf& direct_lx,
           const RadiositySolverOptions& options) {
  const auto fail = [](const std::string& what) {
    throw std::invalid_argument("SolveRadiosity: expected " + what);
  };
  if (area.size() != patches || static_cast<Eigen::Index>(material.size()) != patches ||
      direct_lx.rows() != patches) {
    fail("areas, materials and direct illuminance of every patch");
  }
  if (!(area.array() > 0).all()) fail("areas > 0");
  for (const int m : material) {
    if (m < 0 || m >= albedo.size()) fail("a reflectance for every material");
  }
  if (!(albedo.array() >= 0).all() || !(albedo.array() < 1).all()) {
    fail("reflectances in [0, 1): a room that absorbs no light has no solution");
  }
  if (!direct_lx.allFinite()) fail("finite direct illuminance");
  if (!(options.tolerance_percent > 0)) fail("tolerance_percent > 0");
  if (options.max_iterations < 0 || options.bounces < 0) fail("max_iterations and bounces >= 0");
}

Eigen::VectorXf AlbedoByPatch(const std::vector<int>& material, const Eigen::VectorXd& albedo) {
  Eigen::VectorXf rho(static_cast<Eigen::Index>(material.size()));
  for (size_t i = 0; i < material.size(); ++i)
    rho[static_cast<Eigen::Index>(i)] = static_cast<float>(albedo[material[i]]);
  return rho;
}

RadiositySystem MakeSystem(const LinearTransport& transport, const Eigen::VectorXf& area,
                           const Eigen::VectorXf& rho, const Eigen::MatrixXf& direct_lx,
                           const RadiositySolverOptions& options) {
  RadiositySystem system{transport, rho, area.cwiseSqrt(), {}, 1, {}, options.max_iterations};
  system.source = system.root_area.asDiagonal() * direct_lx;
  if (options.max_iterations == 0) {
    constexpr int kPasses = 1000, kShots = 100;
    const bool shooting = options.solver == RadiositySolver::kShooting;
    system.max_iterations = shooting ? static_cast<int>(std::min<Eigen::Index>(
                                           kShots * transport.size(), std::numeric_limits<int>::max()))
                                     : kPasses;
  }
  if (rho.size() == 0) return system;
  // One product gives (F 1) and (F rho).
  Eigen::MatrixXf probes(rho.size(), 2);
  probes << system.root_area, rho.cwiseProduct(system.root_area);
  const Eigen::MatrixXf sums = system.root_area.cwiseInverse().asDiagonal() * transport.Times(probes);
  double contraction = sums.col(1).maxCoeff();
  if (contraction >= 1) contraction = rho.maxCoeff();
  system.error_factor = std::max(0.0f, sums.col(0).maxCoeff()) / (1 - contraction);
  const Eigen::RowVectorXf mean = AreaMean(direct_lx, system.root_area);
  // Below a few units in the last place of the largest entry, float can resolve no residual.
  const Eigen::RowVectorXf floor = 5e-7f * direct_lx.cwiseAbs().colwise().maxCoeff();
  const double share = 0.01 * options.tolerance_percent / std::max(system.error_factor, 1e-30);
  system.allowed = (static_cast<float>(std::min(share, 1e30)) * mean).cwiseMax(floor);
  return system;
}

RadiosityIterate Iterate(const RadiositySystem& system, RadiositySolver solver, int bounces) {
  switch (solver) {
    case RadiositySolver::kJacobi:
      return SolveJacobi(system);
    case RadiositySolver::kGaussSeidel:
      return SolveGaussSeidel(system);
    case RadiositySolver::kNeumann:
      return SumNeumannSeries(system, bounces);
    case RadiositySolver::kShooting:
      return SolveShooting(system);
    case RadiositySolver::kConjugateGradient:
      return SolveConjugateGradient(system);
    case RadiositySolver::kBicgstab:
      return SolveBicgstab(system);
    default:
      throw std::invalid_argument("SolveRadiosity: " + ToString(solver) +
                                  " needs the dense matrix of a TransportGeometry");
  }
}

RadiosityIterate SolveLu(const RadiositySystem& system, const FormFactorMatrix& coupling) {
  Eigen::MatrixXf matrix = -(system.rho.asDiagonal() * coupling);
  matrix.diagonal().array() += 1.0f;
  RadiosityIterate iterate{system.rho.asDiagonal() * system.source, 1};
  if (!LuSolveInPlace(matrix, iterate.scaled_exitance)) iterate.scaled_exitance.setZero();
  return iterate;
}

// Makes one gathering step: it measures the residual and, but for the truncated series, improves the
// solution.
RadiositySolution Finish(const RadiositySystem& system, const RadiosityIterate& iterate,
                         const RadiositySolverOptions& options, RadiositySolver solver) {
  RadiositySolution solution;
  solution.solver = solver;
  solution.iterations = iterate.iterations;
  const Eigen::MatrixXf& z = iterate.scaled_exitance;
  const Eigen::MatrixXf received = system.source + system.coupling.Times(z);
  const Eigen::MatrixXf gathered = system.rho.asDiagonal() * received;
  const Eigen::VectorXf scale = system.root_area.cwiseInverse();
  const Eigen::RowVectorXf mean_lx = AreaMean(scale.asDiagonal() * received, system.root_area);
  for (Eigen::Index c = 0; c < system.columns() && system.patches() > 0; ++c) {
    if (const float r = system.Largest(gathered.col(c) - z.col(c)); !(r == 0))
      solution.residual = std::max(solution.residual, static_cast<double>(r) / mean_lx[c]);
  }
  const bool truncated = solver == RadiositySolver::kNeumann;
  solution.exitance = scale.asDiagonal() * (truncated ? z : gathered);
  solution.error_percent = 100 * system.error_factor * solution.residual;
  solution.converged = truncated || solution.error_percent <= options.tolerance_percent;
  const std::string bound =
      "error of the illuminance at most " + std::to_string(solution.error_percent) + " % of its mean";
  if (truncated) {
    solution.message = std::to_string(options.bounces) + " reflections; left out: " + bound;
  } else {
    solution.message = (solution.converged ? "converged, " : "not converged, ") + bound;
    if (!solution.converged) solution.message += "; raise max_iterations or tolerance_percent";
  }
  return solution;
}

// Both cost the same at patches / 40 to patches / 25 columns (solver_benchmark, 800 to 8400 patches).
bool IsFactoringCheaper(Eigen::Index patches, Eigen::Index columns) { return columns * 35 > patches; }

}  // namespace

std::string ToString(RadiositySolver solver) {
  for (const NamedSolver& named : kNames) {
    if (named.solver == solver) return named.name;
  }
  return "";
}

RadiositySolution SolveRadiosity(const TransportGeometry& geometry, const Eigen::VectorXd& albedo,
                                 const Eigen::MatrixXf& direct_lx, const RadiositySolverOptions& options) {
  const DenseTransport dense(geometry.coupling);
  Check(dense.size(), geometry.patch_area_m2, geometry.patch_material, albedo, direct_lx, options);
  RadiositySolver solver = options.solver;
  std::string reason = "asked for";
  if (solver == RadiositySolver::kAuto) {
    const bool factoring = IsFactoringCheaper(dense.size(), direct_lx.cols());
    solver = factoring ? RadiositySolver::kCholesky : RadiositySolver::kConjugateGradient;
    reason =
        std::to_string(direct_lx.cols()) + " columns for " + std::to_string(dense.size()) + " patches: " +
        (factoring ? "one factorisation serves them all" : "a few products cost less than a factorisation");
  }
  const RadiositySystem system = MakeSystem(
      dense, geometry.patch_area_m2, AlbedoByPatch(geometry.patch_material, albedo), direct_lx, options);
  RadiosityIterate iterate;
  if (solver == RadiositySolver::kCholesky) {
    const Transport transport(geometry, albedo);
    iterate = {system.root_area.asDiagonal() * transport.Exitance(direct_lx), 1};
  } else if (solver == RadiositySolver::kLu) {
    iterate = SolveLu(system, geometry.coupling);
  } else {
    iterate = Iterate(system, solver, options.bounces);
  }
  RadiositySolution solution = Finish(system, iterate, options, solver);
  solution.reason = reason;
  return solution;
}

RadiositySolution SolveRadiosity(const LinearTransport& transport, const Eigen::VectorXf& patch_area_m2,
                                 const std::vector<int>& patch_material, const Eigen::VectorXd& albedo,
                                 const Eigen::MatrixXf& direct_lx, const RadiositySolverOptions& options) {
  Check(transport.size(), patch_area_m2, patch_material, albedo, direct_lx, options);
  const bool is_auto = options.solver == RadiositySolver::kAuto;
  const RadiositySolver solver = is_auto ? RadiositySolver::kConjugateGradient : options.solver;
  const RadiositySystem system =
      MakeSystem(transport, patch_area_m2, AlbedoByPatch(patch_material, albedo), direct_lx, options);
  RadiositySolution solution = Finish(system, Iterate(system, solver, options.bounces), options, solver);
  solution.reason = is_auto ? "no dense matrix to factor" : "asked for";
  return solution;
}

}  // namespace luxfit
