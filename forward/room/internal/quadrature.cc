#include "forward/room/internal/quadrature.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

namespace luxfit {
namespace {

// Returns the nodes on [0, 1] of the weight (1 - t)^alpha, alpha 0 or 1, from the three-term recurrence of
// the Jacobi polynomials.
std::vector<LineNode> GaussJacobi(int n, int alpha) {
  if (n < 1) throw std::invalid_argument("Gauss quadrature: expected at least one node");
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    const double s = 2.0 * k + alpha;
    // b^2 - a^2 = -alpha^2 with a = alpha, b = 0; the first term needs no limit as alpha is 0 or 1.
    jacobi(k, k) = alpha == 0 ? 0 : -1.0 / (s * (s + 2));
    if (k == 0) continue;
    const double off = alpha == 0
                           ? k / std::sqrt(4.0 * k * k - 1)
                           : std::sqrt(4.0 * k * k * (k + 1.0) * (k + 1.0) / (s * s * (s + 1) * (s - 1)));
    jacobi(k, k - 1) = jacobi(k - 1, k) = off;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobi);
  std::vector<LineNode> nodes;
  for (int k = 0; k < n; ++k) {
    const double first = eigen.eigenvectors()(0, k);
    nodes.push_back({0.5 * (1 + eigen.eigenvalues()(k)), first * first});
  }
  return nodes;
}

}  // namespace

std::vector<LineNode> GaussLegendre(int n) { return GaussJacobi(n, 0); }

std::vector<FacetNode> FacetRule(FacetKind kind, int n) {
  const bool triangle = kind == FacetKind::kTriangle;
  std::vector<FacetNode> rule;
  for (const LineNode& v : GaussJacobi(n, triangle ? 1 : 0)) {
    for (const LineNode& u : GaussLegendre(n)) {
      rule.push_back({triangle ? u.t * (1 - v.t) : u.t, v.t, u.weight * v.weight});
    }
  }
  return rule;
}

}  // namespace luxfit
