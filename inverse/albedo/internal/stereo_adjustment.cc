#include "inverse/albedo/internal/stereo_adjustment.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/albedo/internal/stereo_terms.h"

namespace luxfit {
namespace {

constexpr double kCauchySigmas = 2.385;  // 95 % efficient where errors are normal
constexpr size_t kChunk = 256;           // pixels summed together: the same result on any number of cores
constexpr double kGauge = 1e6;           // weight that holds a shared direction, over the mean weight

// Returns the robust sigma of the used observations, corrected for the unknowns' degrees of freedom.
double RobustSigma(const StereoProblem& problem, const StereoState& state) {
  const Eigen::MatrixXd residuals = StereoResiduals(problem, state);
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
  return std::max(1.4826 * Quantile(std::move(size), 0.5) * std::sqrt(n / freedom), 1e-6);
}

// Holds one pixel's part of the normal equations.
struct PixelBlock {
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xd coupling;  // to the shared unknowns
  bool is_used = false;
};

Eigen::Matrix3d Damped(const PixelBlock& block, double damping) {
  Eigen::Matrix3d h = block.h;
  h.diagonal() *= 1 + damping;
  h.diagonal().array() += 1e-12 * (1 + h.trace());
  return h;
}

struct NormalEquations {
  std::vector<PixelBlock> pixels;
  Eigen::MatrixXd h;
  Eigen::VectorXd g;
};

// Linearizes the adjustment at one state: everything that a step needs.
class Linearization {
 public:
  Linearization(const StereoProblem& problem, const StereoState& state, double sigma)
      : problem_(problem), state_(state), sigma_(sigma), shared_(problem, state) {}

  NormalEquations Equations() const {
    const size_t pixels = static_cast<size_t>(state_.b.cols());
    NormalEquations all{std::vector<PixelBlock>(pixels), {}, {}};
    std::vector<NormalEquations> parts((pixels + kChunk - 1) / kChunk);
    tbb::parallel_for(size_t{0}, parts.size(), [&](size_t chunk) {
      NormalEquations& part = parts[chunk];
      part.h.setZero(shared_.count(), shared_.count());
      part.g.setZero(shared_.count());
      for (size_t i = chunk * kChunk; i < std::min(pixels, (chunk + 1) * kChunk); ++i)
        AddPixel(static_cast<Eigen::Index>(i), all.pixels[i], part);
    });
    all.h = shared_.PriorWeights().asDiagonal();
    all.g = shared_.PriorWeights().cwiseProduct(shared_.PriorDeviation());
    for (const NormalEquations& part : parts) {
      all.h += part.h;
      all.g += part.g;
    }
    return all;
  }

  // Returns gradients by the shared unknowns, shared x images, for each image's observations, pixels
  // eliminated.
  Eigen::MatrixXd ImageScores(const NormalEquations& equations) const {
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(shared_.count(), problem_.value.rows());
    for (Eigen::Index i = 0; i < state_.b.cols(); ++i) {
      const PixelBlock& block = equations.pixels[static_cast<size_t>(i)];
      if (!block.is_used) continue;
      const Eigen::Matrix3Xd by_shared = Damped(block, 0).inverse() * block.coupling;
      const StereoPixel pixel(state_, i);
      for (Eigen::Index k = 0; k < problem_.value.rows(); ++k) {
        if (!problem_.used(k, i)) continue;
        const StereoTerm term = pixel.Term(k);
        const double r = problem_.value(k, i) - term.value;
        const double pull = Weight(r) * r;
        shared_.Row(term, k, [&](Eigen::Index column, double slope) { scores(column, k) += pull * slope; });
        scores.col(k) -= pull * by_shared.transpose() * term.d_b;
      }
    }
    return scores;
  }

  const SharedUnknowns& shared() const { return shared_; }

 private:
  double Weight(double residual) const {
    const double z = residual / (kCauchySigmas * sigma_);
    return (problem_.robust ? 1 / (1 + z * z) : 1) / (sigma_ * sigma_);
  }

  void AddPixel(Eigen::Index i, PixelBlock& block, NormalEquations& part) const {
    block.is_used = state_.b.col(i).squaredNorm() > 0;
    if (!block.is_used) return;
    block.coupling.setZero(3, shared_.count());
    const StereoPixel pixel(state_, i);
    for (Eigen::Index k = 0; k < problem_.value.rows(); ++k) {
      if (!problem_.used(k, i)) continue;
      const StereoTerm term = pixel.Term(k);
      const double r = problem_.value(k, i) - term.value;
      const double w = Weight(r);
      block.h += w * term.d_b * term.d_b.transpose();
      block.g += w * r * term.d_b;
      shared_.Row(term, k, [&](Eigen::Index column, double slope) {
        part.g[column] += w * r * slope;
        block.coupling.col(column) += w * slope * term.d_b;
        shared_.Row(term, k, [&](Eigen::Index other, double other_slope) {
          part.h(column, other) += w * slope * other_slope;
        });
      });
    }
  }

  const StereoProblem& problem_;
  const StereoState& state_;
  double sigma_;
  SharedUnknowns shared_;
};

// Holds the equations of the shared unknowns after the pixels are eliminated.
struct Reduced {
  Eigen::MatrixXd h;
  Eigen::VectorXd g;
};

Reduced Reduce(const NormalEquations& equations, const SharedUnknowns& shared, double damping) {
  Reduced reduced{equations.h, equations.g};
  reduced.h.diagonal() *= 1 + damping;
  const Eigen::Index count = shared.count();
  if (count == 0) return reduced;
  const size_t pixels = equations.pixels.size();
  std::vector<Reduced> parts((pixels + kChunk - 1) / kChunk);
  tbb::parallel_for(size_t{0}, parts.size(), [&](size_t chunk) {
    Reduced& part = parts[chunk];
    part = {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
    Eigen::Matrix3Xd by_shared(3, count);
    for (size_t i = chunk * kChunk; i < std::min(pixels, (chunk + 1) * kChunk); ++i) {
      const PixelBlock& block = equations.pixels[i];
      if (!block.is_used) continue;
      const Eigen::Matrix3d inverse = Damped(block, damping).inverse();
      by_shared.noalias() = inverse * block.coupling;
      part.h.noalias() += block.coupling.transpose() * by_shared;
      part.g.noalias() += by_shared.transpose() * block.g;
    }
  });
  for (const Reduced& part : parts) {
    reduced.h -= part.h;
    reduced.g -= part.g;
  }
  const double mean_weight = std::max(equations.h.diagonal().mean(), 1e-12);
  for (const Eigen::VectorXd& held : shared.HeldDirections())
    reduced.h += kGauge * mean_weight * held * held.transpose();
  return reduced;
}

StereoState Stepped(const StereoState& state, const NormalEquations& equations, const SharedUnknowns& shared,
                    double damping) {
  const Reduced reduced = Reduce(equations, shared, damping);
  Eigen::VectorXd dx = Eigen::VectorXd::Zero(shared.count());
  if (shared.count() > 0) dx = reduced.h.ldlt().solve(reduced.g);
  StereoState next = shared.Applied(state, dx);
  for (Eigen::Index i = 0; i < next.b.cols(); ++i) {
    const PixelBlock& block = equations.pixels[static_cast<size_t>(i)];
    if (!block.is_used) continue;
    Eigen::Vector3d db = Damped(block, damping).inverse() * (block.g - block.coupling * dx);
    // A pixel with few lights must not jump to another branch.
    const double longest = 0.4 * state.b.col(i).norm();
    if (db.norm() > longest) db *= longest / db.norm();
    next.b.col(i) += db;
  }
  return next;
}

double Cost(const StereoProblem& problem, const StereoState& state, double sigma) {
  const Eigen::MatrixXd residuals = StereoResiduals(problem, state);
  double cost = 0;
  for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
    for (Eigen::Index k = 0; k < residuals.rows(); ++k) {
      if (!problem.used(k, i) || !std::isfinite(residuals(k, i))) continue;
      const double z = residuals(k, i) / sigma;
      const double c2 = kCauchySigmas * kCauchySigmas;
      cost += problem.robust ? c2 * std::log1p(z * z / c2) : z * z;
    }
  }
  const SharedUnknowns shared(problem, state);
  return cost + shared.PriorWeights().dot(shared.PriorDeviation().cwiseAbs2());
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
  StereoAdjustment result{start, RobustSigma(problem, start), 0, false};
  double damping = 1e-3;
  for (; result.iterations < max_iterations && !result.converged; ++result.iterations) {
    const Linearization here(problem, result.state, result.residual_sigma);
    const NormalEquations equations = here.Equations();
    const double cost = Cost(problem, result.state, result.residual_sigma);
    double next_cost = cost;
    StereoState next;
    for (int attempt = 0; attempt < 8; ++attempt) {
      next = Stepped(result.state, equations, here.shared(), damping);
      next_cost = Cost(problem, next, result.residual_sigma);
      if (next_cost < cost) break;
      damping *= 6;
    }
    // No step lowers the cost: the minimum is reached.
    if (!(next_cost < cost)) {
      result.converged = true;
      break;
    }
    result.state = std::move(next);
    damping = std::max(damping / 6, 1e-9);
    result.residual_sigma = RobustSigma(problem, result.state);
    result.converged = cost - next_cost < 1e-5 * cost;
  }
  return result;
}

std::vector<Eigen::Matrix3d> StereoCovariance(const StereoProblem& problem,
                                              const StereoAdjustment& adjustment) {
  const Linearization here(problem, adjustment.state, adjustment.residual_sigma);
  const NormalEquations equations = here.Equations();
  const Eigen::Index shared = here.shared().count();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(shared, shared);
  if (shared > 0) {
    const Eigen::MatrixXd inverse =
        Reduce(equations, here.shared(), 0).h.completeOrthogonalDecomposition().pseudoInverse();
    const Eigen::MatrixXd scores = here.ImageScores(equations);
    const double images = static_cast<double>(scores.cols());
    covariance = inverse + images / (images - 1) * inverse * scores * scores.transpose() * inverse;
  }
  std::vector<Eigen::Matrix3d> result(equations.pixels.size(), Eigen::Matrix3d::Constant(NAN));
  tbb::parallel_for(size_t{0}, result.size(), [&](size_t i) {
    const PixelBlock& block = equations.pixels[i];
    if (!block.is_used) return;
    const Eigen::Matrix3d own = Damped(block, 0).inverse();
    result[i] = own;
    if (shared > 0) {
      const Eigen::Matrix3Xd by_shared = own * block.coupling;
      result[i] += by_shared * covariance * by_shared.transpose();
    }
  });
  return result;
}

}  // namespace luxfit
