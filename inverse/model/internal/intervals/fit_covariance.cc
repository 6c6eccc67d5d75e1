#include "inverse/model/internal/intervals/fit_covariance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/model/internal/intervals/cluster_bootstrap.h"
#include "inverse/model/internal/intervals/cluster_sums.h"

namespace luxfit {
namespace {

constexpr double kSingular = 1e-10;  // least relative eigenvalue of a determined direction (scaled H)
constexpr double kLeastLeft = 0.1;   // least share of a direction's information without one cluster
constexpr double kLeastFreedom = 3;
constexpr double kNormal = 1.959964;

// Holds W with W W^T = H^-1 over the directions that the data determine; its columns are such directions.
struct InverseRoot {
  Eigen::MatrixXd root;
  std::vector<Eigen::VectorXd> null_directions;
};

InverseRoot RootOf(const Eigen::MatrixXd& hessian) {
  const Eigen::VectorXd unit = hessian.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(unit.asDiagonal() * hessian * unit.asDiagonal());
  const double largest = eigen.eigenvalues().maxCoeff();
  InverseRoot result;
  result.root = Eigen::MatrixXd::Zero(hessian.rows(), hessian.rows());
  for (Eigen::Index d = 0; d < hessian.rows(); ++d) {
    if (eigen.eigenvalues()[d] > kSingular * largest) {
      result.root.col(d) = unit.cwiseProduct(eigen.eigenvectors().col(d)) / std::sqrt(eigen.eigenvalues()[d]);
    } else {
      result.null_directions.emplace_back(eigen.eigenvectors().col(d));
    }
  }
  return result;
}

// Returns (I - S)^-1 for one cluster's information S in whitened directions; at least kLeastLeft remains.
Eigen::MatrixXd WithoutCluster(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> leverage(information);
  const Eigen::VectorXd left = (1 - leverage.eigenvalues().array()).max(kLeastLeft);
  return leverage.eigenvectors() * left.cwiseInverse().asDiagonal() * leverage.eigenvectors().transpose();
}

// Holds, along the axes of H, the variance that clusters give: as their scatter estimates it, and as
// independent rows would.
struct ClusterVariance {
  Eigen::MatrixXd estimated, if_independent;
  Eigen::VectorXd share, share_squares;  // sums of v_c and v_c^2
};

ClusterVariance VarianceOfClusters(const ClusteredRows& whitened) {
  const Eigen::Index n = whitened.jacobian.cols();
  ClusterVariance sum{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n),
                      Eigen::VectorXd::Zero(n)};
  const ClusterSums sums = SumClusters(whitened);
  for (Eigen::Index c = 0; c < sums.count(); ++c) {
    const auto information = sums.InformationOf(c);
    const Eigen::MatrixXd without = WithoutCluster(information);
    const Eigen::VectorXd moved = without * sums.gradient.col(c);
    sum.estimated += moved * moved.transpose();
    sum.if_independent += information;
    const Eigen::VectorXd share = (without * information).cwiseProduct(without).rowwise().sum().cwiseMax(0);
    sum.share += share;
    sum.share_squares += share.cwiseAbs2();
  }
  return sum;
}

// Holds the variance along one axis, and its degrees of freedom; 0 where the clusters say nothing of it.
struct AxisVariance {
  double variance = 0, freedom = std::numeric_limits<double>::infinity();

  double Enlarged() const { return variance * std::pow(StudentFactor(freedom), 2); }
};

AxisVariance AlongAxis(const ClusterVariance& clusters, Eigen::Index axis, double known) {
  const double variance = clusters.estimated(axis, axis), squares = clusters.share_squares[axis];
  if (!(variance > 0) || !(squares > 0)) return {};
  const double of_clusters = clusters.share[axis] * clusters.share[axis] / squares;
  return {variance, of_clusters * std::pow(1 + known / variance, 2)};
}

Eigen::MatrixXd HessianOf(const WeightedRows& rows) {
  return rows.jacobian.transpose() * rows.jacobian + rows.prior_information;
}

// Returns the variance that rows which stand alone and priors add, in whitened parameters.
Eigen::MatrixXd KnownVariance(const WeightedRows& rows, const Eigen::MatrixXd& whitened_jacobian,
                              const Eigen::MatrixXd& root) {
  std::vector<bool> is_alone(rows.cluster.size());
  for (size_t i = 0; i < rows.cluster.size(); ++i) is_alone[i] = rows.cluster[i] < 0;
  for (const SpreadRow& spread : rows.spread) is_alone[static_cast<size_t>(spread.row)] = false;
  std::vector<Eigen::Index> alone;
  for (size_t i = 0; i < is_alone.size(); ++i) {
    if (is_alone[i]) alone.push_back(static_cast<Eigen::Index>(i));
  }
  const Eigen::MatrixXd jacobian = whitened_jacobian(alone, Eigen::all);
  return root.transpose() * rows.prior_information * root +
         rows.alone_scatter * jacobian.transpose() * jacobian;
}

// Returns the clusters' covariance raised where it is below that of independent rows, S: eigenvalues relative to S are at
// least 1. Fewer clusters than parameters leave directions across the axes in which their scatter is 0.
Eigen::MatrixXd AtLeastIndependent(const Eigen::MatrixXd& estimated, const Eigen::MatrixXd& independent) {
  constexpr double kTold = 1e-9;  // least share of a direction's information that is the clusters'
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_rows(independent);
  const Eigen::Index told = (of_rows.eigenvalues().array() > kTold).count();  // the last ones: they ascend
  if (told == 0) return estimated;
  const Eigen::VectorXd scale = of_rows.eigenvalues().tail(told).cwiseSqrt();
  const Eigen::MatrixXd axes = of_rows.eigenvectors().rightCols(told),
                        inverse = axes * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> relative(inverse.transpose() * estimated * inverse);
  const Eigen::MatrixXd back = axes * scale.asDiagonal() * relative.eigenvectors();
  const Eigen::VectorXd lacking = (1 - relative.eigenvalues().array()).cwiseMax(0);
  return estimated + back * lacking.asDiagonal() * back.transpose();
}

}  // namespace

double DesignEffect(const WeightedRows& rows) {
  const Eigen::MatrixXd root = RootOf(HessianOf(rows)).root;
  const ClusterVariance clusters =
      VarianceOfClusters({rows.jacobian * root, rows.residual, rows.cluster, rows.spread});
  // Where other knowledge gives nearly all, the ratio says nothing.
  constexpr double kLeastShare = 0.1;
  std::vector<double> ratio;
  for (Eigen::Index d = 0; d < clusters.if_independent.rows(); ++d) {
    if (clusters.if_independent(d, d) > kLeastShare)
      ratio.push_back(clusters.estimated(d, d) / clusters.if_independent(d, d));
  }
  return ratio.empty() ? 1 : std::max(1.0, Median(std::move(ratio)));
}

double StudentFactor(double degrees_of_freedom) {
  const double nu = std::max(degrees_of_freedom, kLeastFreedom), z = kNormal, z3 = z * z * z, z5 = z3 * z * z,
               z7 = z5 * z * z;
  // Cornish-Fisher expansion, Abramowitz and Stegun 26.7.5; within 0.2 % at nu = 3.
  const double t = z + (z3 + z) / (4 * nu) + (5 * z5 + 16 * z3 + 3 * z) / (96 * nu * nu) +
                   (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * std::pow(nu, 3)) +
                   (79 * z7 * z * z + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / (92160 * std::pow(nu, 4));
  return t / z;
}

Eigen::MatrixXd InverseOf(const Eigen::MatrixXd& hessian) {
  const Eigen::MatrixXd root = RootOf(hessian).root;
  return root * root.transpose();
}

FitCovariance CovarianceOf(const WeightedRows& rows) {
  const Eigen::Index n = rows.jacobian.cols();
  InverseRoot inverse_root = RootOf(HessianOf(rows));
  const Eigen::MatrixXd& root = inverse_root.root;

  // In whitened directions the plain covariance is 1, so combinations that cancel stay cancelled.
  ClusteredRows whitened_rows{rows.jacobian * root, rows.residual, rows.cluster, rows.spread};
  const Eigen::MatrixXd known = KnownVariance(rows, whitened_rows.jacobian, root);
  const ClusterVariance fine = VarianceOfClusters(whitened_rows);
  Eigen::VectorXd least = BootstrapVariance(whitened_rows, known).cwiseMax(1);
  whitened_rows.cluster = rows.coarse_cluster;
  whitened_rows.spread = rows.coarse_spread;
  const ClusterVariance coarse = VarianceOfClusters(whitened_rows);
  least = least.cwiseMax(BootstrapVariance(whitened_rows, known));

  FitCovariance result;
  result.null_directions = std::move(inverse_root.null_directions);
  result.degrees_of_freedom = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  Eigen::VectorXd larger = Eigen::VectorXd::Ones(n), raised = larger;
  for (Eigen::Index d = 0; d < n; ++d) {
    const AxisVariance of_fine = AlongAxis(fine, d, known(d, d)),
                       of_coarse = AlongAxis(coarse, d, known(d, d));
    if (!(of_fine.variance > 0)) continue;
    result.degrees_of_freedom[d] = of_fine.freedom;
    const double enlarged = std::max(of_fine.Enlarged(), of_coarse.Enlarged());
    larger[d] = std::sqrt(enlarged / of_fine.variance);
  }
  const Eigen::MatrixXd enlarged = larger.asDiagonal() * fine.estimated * larger.asDiagonal();
  Eigen::MatrixXd whitened = known + AtLeastIndependent(enlarged, fine.if_independent);
  for (Eigen::Index d = 0; d < n; ++d) {
    if (whitened(d, d) > 0) raised[d] = std::sqrt(std::max(1.0, least[d] / whitened(d, d)));
  }
  whitened = raised.asDiagonal() * whitened * raised.asDiagonal();
  if (rows.biases.size() > 0) {
    const Eigen::MatrixXd moved = root.transpose() * (rows.jacobian.transpose() * rows.biases);
    whitened += moved * moved.transpose();
  }
  result.covariance = root * whitened * root.transpose();
  return result;
}

}  // namespace luxfit
