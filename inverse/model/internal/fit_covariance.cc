#include "inverse/model/internal/fit_covariance.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

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

struct ClusterSums {
  Eigen::VectorXd gradient;     // J_c^T r_c
  Eigen::MatrixXd information;  // J_c^T J_c
};

std::vector<ClusterSums> SumClusters(const WeightedRows& rows) {
  const Eigen::Index n = rows.jacobian.cols();
  const int count =
      rows.cluster.empty() ? 0 : *std::max_element(rows.cluster.begin(), rows.cluster.end()) + 1;
  std::vector<ClusterSums> sums(static_cast<size_t>(count),
                                {Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)});
  for (size_t i = 0; i < rows.cluster.size(); ++i) {
    if (rows.cluster[i] < 0) continue;
    ClusterSums& c = sums[static_cast<size_t>(rows.cluster[i])];
    const Eigen::VectorXd row = rows.jacobian.row(static_cast<Eigen::Index>(i)).transpose();
    c.gradient += rows.residual[static_cast<Eigen::Index>(i)] * row;
    c.information.selfadjointView<Eigen::Lower>().rankUpdate(row);
  }
  for (ClusterSums& c : sums) c.information = Eigen::MatrixXd(c.information.selfadjointView<Eigen::Lower>());
  return sums;
}

// Returns (I - S)^-1 for one cluster's information S in whitened directions; at least kLeastLeft remains.
Eigen::MatrixXd WithoutCluster(const Eigen::MatrixXd& information) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> leverage(information);
  const Eigen::VectorXd left = (1 - leverage.eigenvalues().array()).max(kLeastLeft);
  return leverage.eigenvectors() * left.cwiseInverse().asDiagonal() * leverage.eigenvectors().transpose();
}

}  // namespace

double StudentFactor(double degrees_of_freedom) {
  const double nu = std::max(degrees_of_freedom, kLeastFreedom), z = kNormal, z3 = z * z * z, z5 = z3 * z * z,
               z7 = z5 * z * z;
  // Cornish-Fisher expansion, Abramowitz and Stegun 26.7.5; within 0.2 % at nu = 3.
  const double t = z + (z3 + z) / (4 * nu) + (5 * z5 + 16 * z3 + 3 * z) / (96 * nu * nu) +
                   (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * std::pow(nu, 3)) +
                   (79 * z7 * z * z + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / (92160 * std::pow(nu, 4));
  return t / z;
}

FitCovariance CovarianceOf(const WeightedRows& rows) {
  const Eigen::Index n = rows.jacobian.cols();
  const Eigen::MatrixXd hessian = rows.jacobian.transpose() * rows.jacobian + rows.prior_information;
  InverseRoot inverse_root = RootOf(hessian);
  const Eigen::MatrixXd& root = inverse_root.root;

  // In whitened directions the plain covariance is 1, so combinations that cancel stay cancelled.
  Eigen::MatrixXd known = root.transpose() * rows.prior_information * root;
  for (size_t i = 0; i < rows.cluster.size(); ++i) {
    if (rows.cluster[i] >= 0) continue;
    const Eigen::VectorXd row =
        root.transpose() * rows.jacobian.row(static_cast<Eigen::Index>(i)).transpose();
    known += rows.alone_scatter * row * row.transpose();
  }
  Eigen::MatrixXd estimated = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n), squares = sum;
  for (const ClusterSums& c : SumClusters(rows)) {
    const Eigen::MatrixXd information = root.transpose() * c.information * root;
    const Eigen::MatrixXd without = WithoutCluster(information);
    const Eigen::VectorXd moved = without * (root.transpose() * c.gradient);
    estimated += moved * moved.transpose();
    const Eigen::VectorXd share = (without * information).cwiseProduct(without).rowwise().sum().cwiseMax(0);
    sum += share;
    squares += share.cwiseAbs2();
  }

  FitCovariance result;
  result.null_directions = std::move(inverse_root.null_directions);
  result.degrees_of_freedom = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  Eigen::VectorXd student = Eigen::VectorXd::Ones(n), floor = student;
  for (Eigen::Index d = 0; d < n; ++d) {
    if (!(estimated(d, d) > 0) || !(squares[d] > 0)) continue;
    const double of_clusters = sum[d] * sum[d] / squares[d];
    result.degrees_of_freedom[d] = of_clusters * std::pow(1 + known(d, d) / estimated(d, d), 2);
    student[d] = StudentFactor(result.degrees_of_freedom[d]);
  }
  Eigen::MatrixXd whitened = known + Eigen::MatrixXd(student.asDiagonal() * estimated * student.asDiagonal());
  for (Eigen::Index d = 0; d < n; ++d) {
    if (whitened(d, d) > 0) floor[d] = std::max(1.0, 1 / std::sqrt(whitened(d, d)));
  }
  whitened = floor.asDiagonal() * whitened * floor.asDiagonal();
  if (rows.biases.size() > 0) {
    const Eigen::MatrixXd moved = root.transpose() * (rows.jacobian.transpose() * rows.biases);
    whitened += moved * moved.transpose();
  }
  result.covariance = root * whitened * root.transpose();
  return result;
}

}  // namespace luxfit
