#include "inverse/model/internal/intervals/cluster_bootstrap.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr Eigen::Index kBootstrapDraws = 199;  // quantiles of 2.5 and 97.5 % are draws 5 and 195
constexpr std::uint64_t kBootstrapSeed = 20080801;
constexpr double kFewestClusters = 5;
constexpr double kSingularDraw = 1e-8;  // least pivot of a draw's information; the whole fit's is 1

// Returns an orthonormal basis of the directions that at least five clusters carry: the axes where these are all.
Eigen::MatrixXd CarriedDirections(const ClusterSums& sums) {
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(sums.gradient.rows(), sums.gradient.rows());
  for (Eigen::Index c = 0; c < sums.count(); ++c)
    squares.selfadjointView<Eigen::Lower>().rankUpdate(sums.InformationOf(c));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(squares);
  constexpr double kRounding = 1e-9;
  const auto carried = (eigen.eigenvalues().array() <= 1 / kFewestClusters + kRounding).count();
  if (carried == squares.rows()) return Eigen::MatrixXd::Identity(carried, carried);
  return eigen.eigenvectors().leftCols(carried);  // eigenvalues increase
}

// Holds the draws, one in each column: how much oftener a cluster was taken than in the fit, and the gradient.
struct Draws {
  Eigen::MatrixXd surplus;   // m_c - 1: clusters x draws
  Eigen::MatrixXd gradient;  // parameters x draws
};

Draws DrawClusters(const ClusterSums& sums, const Eigen::MatrixXd& known_variance) {
  const Eigen::Index n = sums.gradient.rows(), clusters = sums.count();
  std::mt19937_64 rng(kBootstrapSeed);
  std::uniform_int_distribution<Eigen::Index> any(0, clusters - 1);
  std::normal_distribution<double> normal;
  Draws draws{Eigen::MatrixXd::Constant(clusters, kBootstrapDraws, -1), Eigen::MatrixXd(n, kBootstrapDraws)};
  for (Eigen::Index b = 0; b < kBootstrapDraws; ++b) {
    for (Eigen::Index taken = 0; taken < clusters; ++taken) draws.surplus(any(rng), b) += 1;
    for (Eigen::Index i = 0; i < n; ++i) draws.gradient(i, b) = normal(rng);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> known(known_variance);
  const Eigen::VectorXd sigma = known.eigenvalues().cwiseMax(0).cwiseSqrt();
  draws.gradient = known.eigenvectors() * sigma.asDiagonal() * draws.gradient;
  draws.gradient += sums.gradient * draws.surplus;
  return draws;
}

// Replaces the gradients of draws [first, first + count) by the steps. A step of NaN: the draw is singular.
void TakeSteps(const ClusterSums& sums, Eigen::Index first, Eigen::Index count, Draws& draws) {
  const Eigen::Index n = sums.gradient.rows();
  // Lower triangles of all draws at once: one product for each of their columns.
  Eigen::MatrixXd information(n * n, count);
  for (Eigen::Index j = 0; j < n; ++j) {
    information.middleRows(j * n + j, n - j).noalias() =
        sums.information.middleRows(j * n + j, n - j) * draws.surplus.middleCols(first, count);
  }
  for (Eigen::Index b = 0; b < count; ++b) {
    Eigen::Map<Eigen::MatrixXd> of_draw(information.col(b).data(), n, n);
    of_draw.diagonal().array() += 1;
    Eigen::Ref<Eigen::MatrixXd> in_place(of_draw);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(in_place);
    auto step = draws.gradient.col(first + b);
    if (cholesky.info() == Eigen::Success && of_draw.diagonal().cwiseAbs2().minCoeff() > kSingularDraw) {
      cholesky.solveInPlace(step);
    } else {
      step.setConstant(std::nan(""));
    }
  }
}

// Returns the steps of all draws that are not singular: parameters x draws.
Eigen::MatrixXd StepsOf(const ClusterSums& sums, const Eigen::MatrixXd& known_variance) {
  constexpr Eigen::Index kAtOnce = 50;
  Draws draws = DrawClusters(sums, known_variance);
  tbb::parallel_for(Eigen::Index{0}, (kBootstrapDraws + kAtOnce - 1) / kAtOnce, [&](Eigen::Index block) {
    const Eigen::Index first = block * kAtOnce;
    TakeSteps(sums, first, std::min(kAtOnce, kBootstrapDraws - first), draws);
  });
  std::vector<Eigen::Index> usable;
  for (Eigen::Index b = 0; b < kBootstrapDraws; ++b) {
    if (draws.gradient.col(b).allFinite()) usable.push_back(b);
  }
  return -draws.gradient(Eigen::all, usable);
}

// Returns the width of the 95 % interval over that of a normal distribution of unit sigma.
double RobustScale(const Eigen::VectorXd& drawn) {
  constexpr double kNormalWidth = 3.92;
  const std::vector<double> values(drawn.begin(), drawn.end());
  return (Quantile(values, 0.975) - Quantile(values, 0.025)) / kNormalWidth;
}

}  // namespace

Eigen::VectorXd BootstrapVariance(const ClusteredRows& rows, const Eigen::MatrixXd& known_variance) {
  const Eigen::Index n = rows.jacobian.cols();
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(n);
  ClusterSums sums = SumClusters(rows);
  if (sums.count() == 0) return variance;
  const Eigen::MatrixXd carried = CarriedDirections(sums);
  if (carried.cols() == 0) return variance;
  if (carried.cols() < n)
    sums = SumClusters({rows.jacobian * carried, rows.residual, rows.cluster, rows.spread});
  const Eigen::MatrixXd steps = StepsOf(sums, carried.transpose() * known_variance * carried);
  if (2 * steps.cols() < kBootstrapDraws) return variance;
  const Eigen::MatrixXd along_axes = carried * steps;
  for (Eigen::Index d = 0; d < n; ++d) variance[d] = std::pow(RobustScale(along_axes.row(d)), 2);
  return variance;
}

}  // namespace luxfit
