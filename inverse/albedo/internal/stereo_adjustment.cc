#include "inverse/albedo/internal/stereo_adjustment.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/albedo/internal/pixel_elimination.h"
#include "inverse/albedo/internal/stereo_terms.h"
#include "inverse/model/internal/condensed_problem.h"
#include "inverse/select/internal/robust_weight.h"

namespace luxfit {
namespace {

constexpr double kCauchySigmas = 2.385;  // 95 % efficient where errors are normal

// Returns the robust sigma of the used observations, corrected for the unknowns' degrees of freedom.
double RobustSigma(const StereoProblem& problem, const StereoState& state, const Eigen::MatrixXd& residuals) {
  std::vector<double> size;
  size.reserve(static_cast<size_t>(residuals.size()));
  Eigen::Index unknowns = SharedUnknowns(problem, state).count();
  for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
    const size_t before = size.size();
    for (Eigen::Index k = 0; k < residuals.rows(); ++k) {
      if (problem.used(k, i) && std::isfinite(residuals(k, i))) size.push_back(std::abs(residuals(k, i)));
    }
    if (size.size() > before) unknowns += 3;
  }
  if (size.empty()) return 1;
  const double n = static_cast<double>(size.size());
  const double freedom = std::max(1.0, n - static_cast<double>(unknowns));
  // Values are about 1 in size: noise below this is rounding.
  return std::max(kSigmaPerMad * Quantile(std::move(size), 0.5) * std::sqrt(n / freedom), 1e-6);
}

// Returns the weights of the used observations by Cauchy's loss, 0 of the others.
Eigen::MatrixXd WeightsOf(const StereoProblem& problem, const Eigen::MatrixXd& residuals, double sigma) {
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(residuals.rows(), residuals.cols());
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const double r = residuals.data()[i];
    if (!problem.used.data()[i] || !std::isfinite(r)) continue;
    weight.data()[i] = (problem.robust ? CauchyWeight(r / sigma, kCauchySigmas) : 1) / (sigma * sigma);
  }
  return weight;
}

double Cost(const StereoProblem& problem, const StereoState& state, const Eigen::MatrixXd& residuals,
            double sigma) {
  double cost = 0;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const double z = residuals.data()[i] / sigma;
    if (!problem.used.data()[i] || !std::isfinite(z)) continue;
    cost += problem.robust ? CauchyLoss(z, kCauchySigmas) : z * z;
  }
  const SharedUnknowns shared(problem, state);
  NormalEquations priors(shared.count());
  shared.AddPriors(Eigen::VectorXd::Zero(shared.count()), priors);
  return cost + priors.squares;
}

// Scales strengths to the geometric mean of the given ones, and the albedos inversely. No prediction changes.
void KeepMeanStrength(const Eigen::VectorXd& given, StereoState& state) {
  const double factor = std::exp((given.array() / state.strength.array()).log().mean());
  state.strength *= factor;
  state.b /= factor;
}

// Returns the state after one step of the shared unknowns, with every pixel at its best. Updates the radius
// of the trust region.
StereoState Stepped(const StereoProblem& problem, const Eigen::MatrixXd& weight, const StereoState& state,
                    double& radius) {
  PixelElimination pixels(problem, weight, state);
  CondensedProblem condensed;
  condensed.equations = [&](const Eigen::VectorXd& x) { return pixels.EquationsAt(x); };
  condensed.lower = pixels.shared().lower();
  condensed.upper = pixels.shared().upper();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(pixels.shared().count());
  InnerSolveOptions options;
  options.is_near = true;  // the weights are due again after every step
  options.near_radius = radius;
  radius = SolveCondensed(condensed, options, x);
  return pixels.StateAt(x);
}

}  // namespace

Eigen::Matrix3Xd SolveLambert(const StereoProblem& problem, const Eigen::VectorXd& strength) {
  Eigen::Matrix3Xd b = Eigen::Matrix3Xd::Zero(3, problem.value.cols());
  tbb::parallel_for(Eigen::Index{0}, b.cols(), [&](Eigen::Index i) {
    Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (Eigen::Index k = 0; k < problem.value.rows(); ++k) {
      if (!problem.used(k, i)) continue;
      const Eigen::Vector3d light = strength[k] * problem.to_light.col(k);
      h += light * light.transpose();
      g += light * problem.value(k, i);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(h);
    // Where the lights lie nearly in a plane, the normal across it would be noise.
    constexpr double kLeastShare = 1e-4;
    if (!(eigen.eigenvalues()[0] > kLeastShare * eigen.eigenvalues()[2])) return;
    b.col(i) = h.inverse() * g;
  });
  return b;
}

Eigen::MatrixXd StereoResiduals(const StereoProblem& problem, const StereoState& state) {
  Eigen::MatrixXd residuals = Eigen::MatrixXd::Constant(problem.value.rows(), problem.value.cols(), NAN);
  tbb::parallel_for(Eigen::Index{0}, problem.value.cols(), [&](Eigen::Index i) {
    if (!(state.b.col(i).squaredNorm() > 0)) return;
    const StereoPixel pixel(state, i);
    for (Eigen::Index k = 0; k < problem.value.rows(); ++k) {
      if (std::isfinite(problem.value(k, i)))
        residuals(k, i) = problem.value(k, i) - pixel.Term(k, /*with_slopes=*/false).value;
    }
  });
  return residuals;
}

StereoAdjustment AdjustStereo(const StereoProblem& problem, const StereoState& start, int max_iterations) {
  constexpr double kSmallGain = 1e-5, kFirstRadius = 1e3;
  Eigen::MatrixXd residuals = StereoResiduals(problem, start);
  double radius = kFirstRadius;
  StereoAdjustment result{start, RobustSigma(problem, start, residuals), 0, false};
  for (; result.iterations < max_iterations && !result.converged; ++result.iterations) {
    const double sigma = result.residual_sigma;
    StereoState next = Stepped(problem, WeightsOf(problem, residuals, sigma), result.state, radius);
    const double cost = Cost(problem, result.state, residuals, sigma);
    Eigen::MatrixXd next_residuals = StereoResiduals(problem, next);
    const double next_cost = Cost(problem, next, next_residuals, sigma);
    result.converged = !(cost - next_cost > kSmallGain * cost);
    if (!(next_cost < cost)) break;
    result.state = std::move(next);
    residuals = std::move(next_residuals);
    result.residual_sigma = RobustSigma(problem, result.state, residuals);
  }
  if (problem.strengths_free) KeepMeanStrength(start.strength, result.state);
  return result;
}

std::vector<Eigen::Matrix3d> StereoCovariance(const StereoProblem& problem,
                                              const StereoAdjustment& adjustment) {
  const StereoState& state = adjustment.state;
  const Eigen::MatrixXd weight =
      WeightsOf(problem, StereoResiduals(problem, state), adjustment.residual_sigma);
  const SharedUnknowns shared(problem, state);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(shared.count(), shared.count());
  if (shared.count() > 0) {
    const StereoEquations equations = ReducedEquations(problem, weight, state);
    // Held directions have no sigma: the albedo is known up to that factor.
    const Eigen::MatrixXd determined =
        Eigen::MatrixXd::Identity(shared.count(), shared.count()) - shared.held() * shared.held().transpose();
    const Eigen::MatrixXd inverse =
        determined * equations.reduced.matrix.completeOrthogonalDecomposition().pseudoInverse() * determined;
    const Eigen::MatrixXd pull = inverse * equations.scores;
    const double images = static_cast<double>(pull.cols());
    covariance = inverse + images / (images - 1) * pull * pull.transpose();
  }
  std::vector<Eigen::Matrix3d> result(static_cast<size_t>(state.b.cols()), Eigen::Matrix3d::Constant(NAN));
  tbb::parallel_for(Eigen::Index{0}, state.b.cols(), [&](Eigen::Index i) {
    if (!(state.b.col(i).squaredNorm() > 0)) return;
    const PixelRows rows(problem, weight, state, i);
    const Eigen::Matrix3Xd by_shared = rows.Covariance() * rows.Coupling(shared);
    result[static_cast<size_t>(i)] = rows.Covariance() + by_shared * covariance * by_shared.transpose();
  });
  return result;
}

}  // namespace luxfit
