// Solves by Jacobi, Gauss-Seidel and the Neumann series.
//
// Both iterations stop by the last change of M. The residual left after a pass is rho times the part of F
// that saw old values times that change, hence no larger.
#include <algorithm>

#include "forward/radiosity/internal/radiosity_system.h"

namespace luxfit {
namespace {

// Rows that one product serves before their mutual corrections: large enough to stream K in parallel, small
// enough that the corrections (rows^2 each) stay negligible.
constexpr Eigen::Index kBlockRows = 256;

Eigen::VectorXf Diagonal(const LinearTransport& coupling) {
  const Eigen::Index n = coupling.size();
  Eigen::VectorXf diagonal(n);
  for (Eigen::Index first = 0; first < n; first += kBlockRows) {
    const Eigen::Index count = std::min(kBlockRows, n - first);
    diagonal.segment(first, count) = coupling.DiagonalBlock(first, count).diagonal();
  }
  return diagonal;
}

}  // namespace

RadiosityIterate SolveJacobi(const RadiositySystem& system) {
  const Eigen::VectorXf diagonal = Diagonal(system.coupling);
  const Eigen::VectorXf scale =
      system.rho.cwiseQuotient((1 - system.rho.array() * diagonal.array()).matrix());
  RadiosityIterate iterate{scale.asDiagonal() * system.source, 0};
  Eigen::MatrixXf& z = iterate.scaled_exitance;
  Eigen::MatrixXf change = z;
  while (iterate.iterations < system.max_iterations && !system.IsSmall(change)) {
    const Eigen::MatrixXf next =
        scale.asDiagonal() * (system.source + system.coupling.Times(z) - diagonal.asDiagonal() * z);
    change = next - z;
    z = next;
    ++iterate.iterations;
  }
  return iterate;
}

RadiosityIterate SolveGaussSeidel(const RadiositySystem& system) {
  RadiosityIterate iterate{system.rho.asDiagonal() * system.source, 0};
  Eigen::MatrixXf& z = iterate.scaled_exitance;
  Eigen::MatrixXf change = z;
  while (iterate.iterations < system.max_iterations && !system.IsSmall(change)) {
    for (Eigen::Index first = 0; first < system.patches(); first += kBlockRows) {
      const Eigen::Index count = std::min(kBlockRows, system.patches() - first);
      const Eigen::MatrixXf block = system.coupling.DiagonalBlock(first, count);
      const Eigen::MatrixXf received = system.coupling.RowsTimes(first, count, z);
      for (Eigen::Index k = 0; k < count; ++k) {
        const Eigen::Index i = first + k;
        // Adds the changes of earlier rows of this block since the product was formed.
        const Eigen::RowVectorXf total =
            system.source.row(i) + received.row(k) + block.row(k).head(k) * change.middleRows(first, k);
        const float self = block(k, k);
        const Eigen::RowVectorXf next =
            system.rho[i] * (total - self * z.row(i)) / (1 - system.rho[i] * self);
        change.row(i) = next - z.row(i);
        z.row(i) = next;
      }
    }
    ++iterate.iterations;
  }
  return iterate;
}

RadiosityIterate SumNeumannSeries(const RadiositySystem& system, int bounces) {
  RadiosityIterate iterate{Eigen::MatrixXf::Zero(system.patches(), system.columns()), bounces};
  if (bounces == 0) return iterate;
  Eigen::MatrixXf term = system.rho.asDiagonal() * system.source;
  iterate.scaled_exitance = term;
  for (int k = 1; k < bounces; ++k) {
    term = system.rho.asDiagonal() * system.coupling.Times(term);
    iterate.scaled_exitance += term;
  }
  return iterate;
}

}  // namespace luxfit
