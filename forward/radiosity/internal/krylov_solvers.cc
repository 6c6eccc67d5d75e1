// Solves by conjugate gradients and BiCGSTAB, all columns at once so that each pass over K serves them all.
//
// Scalars are sums in double: in float those of 10^5 patches would lose the digits that orthogonality needs.
#include <cmath>

#include "forward/radiosity/internal/radiosity_system.h"

namespace luxfit {
namespace {

using Scalars = Eigen::Array<double, 1, Eigen::Dynamic>;

Scalars Dot(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
  Scalars dots(a.cols());
  for (Eigen::Index c = 0; c < a.cols(); ++c) dots[c] = a.col(c).cast<double>().dot(b.col(c).cast<double>());
  return dots;
}

// Returns 0 for a column that is solved: it has nothing left to divide.
Scalars Ratio(const Scalars& a, const Scalars& b) { return (b.abs() > 1e-300).select(a / b, 0.0); }

// Returns x + y * s, column by column.
Eigen::MatrixXf Plus(const Eigen::MatrixXf& x, const Eigen::MatrixXf& y, const Scalars& s) {
  return x + y * s.matrix().transpose().cast<float>().asDiagonal();
}

}  // namespace

// Solves S x = R g, S = I - R K R, R = sqrt(rho), z = R x: the residual of z is R times that of x.
RadiosityIterate SolveConjugateGradient(const RadiositySystem& system) {
  const Eigen::VectorXf root_rho = system.rho.cwiseSqrt();
  const auto times_root = [&](const Eigen::MatrixXf& x) -> Eigen::MatrixXf {
    return root_rho.asDiagonal() * x;
  };
  RadiosityIterate iterate;
  Eigen::MatrixXf residual = times_root(system.source);
  Eigen::MatrixXf x = Eigen::MatrixXf::Zero(system.patches(), system.columns());
  Eigen::MatrixXf direction = residual;
  Scalars norm = Dot(residual, residual);
  while (iterate.iterations < system.max_iterations && !system.IsSmall(times_root(residual))) {
    const Eigen::MatrixXf image = direction - times_root(system.coupling.Times(times_root(direction)));
    const Scalars alpha = Ratio(norm, Dot(direction, image));
    x = Plus(x, direction, alpha);
    residual = Plus(residual, image, -alpha);
    const Scalars next_norm = Dot(residual, residual);
    direction = Plus(residual, direction, Ratio(next_norm, norm));
    norm = next_norm;
    ++iterate.iterations;
  }
  iterate.scaled_exitance = times_root(x);
  return iterate;
}

// Solves (I - rho K) z = rho g.
RadiosityIterate SolveBicgstab(const RadiositySystem& system) {
  const auto image_of = [&](const Eigen::MatrixXf& x) -> Eigen::MatrixXf {
    return x - system.rho.asDiagonal() * system.coupling.Times(x);
  };
  RadiosityIterate iterate;
  Eigen::MatrixXf residual = system.rho.asDiagonal() * system.source;
  Eigen::MatrixXf& z = iterate.scaled_exitance = Eigen::MatrixXf::Zero(system.patches(), system.columns());
  const Eigen::MatrixXf shadow = residual;
  Eigen::MatrixXf direction = residual;
  Scalars projection = Dot(shadow, residual);
  while (iterate.iterations < system.max_iterations && !system.IsSmall(residual)) {
    const Eigen::MatrixXf image = image_of(direction);
    const Scalars alpha = Ratio(projection, Dot(shadow, image));
    const Eigen::MatrixXf half = Plus(residual, image, -alpha);
    const Eigen::MatrixXf half_image = image_of(half);
    const Scalars omega = Ratio(Dot(half_image, half), Dot(half_image, half_image));
    z = Plus(Plus(z, direction, alpha), half, omega);
    residual = Plus(half, half_image, -omega);
    const Scalars next_projection = Dot(shadow, residual);
    const Scalars beta = Ratio(next_projection, projection) * Ratio(alpha, omega);
    direction = Plus(residual, Plus(direction, image, -omega), beta);
    projection = next_projection;
    ++iterate.iterations;
  }
  return iterate;
}

}  // namespace luxfit
