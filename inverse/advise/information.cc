#include "inverse/advise/information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace luxfit {
namespace {

void ExpectSquare(const Eigen::MatrixXd& root, const Eigen::MatrixXd& information) {
  if (information.rows() != root.rows() || information.cols() != root.rows())
    throw std::invalid_argument("CovarianceWith: expected an information of as many rows as parameters");
}

// Returns the parameters of which the information tells: of a state, those of the luminaires that are on.
std::vector<Eigen::Index> Told(const Eigen::MatrixXd& information) {
  std::vector<Eigen::Index> told;
  for (Eigen::Index i = 0; i < information.rows(); ++i) {
    if (information(i, i) > 0) told.push_back(i);
  }
  return told;
}

// Returns the Cholesky factor of 1 + L^T I L.
Eigen::LLT<Eigen::MatrixXd> Gained(const Eigen::MatrixXd& root, const Eigen::MatrixXd& information) {
  ExpectSquare(root, information);
  const std::vector<Eigen::Index> told = Told(information);
  const Eigen::MatrixXd told_root = root(told, Eigen::all), told_information = information(told, told);
  Eigen::MatrixXd gained = told_root.transpose() * (told_information * told_root);
  gained.diagonal().array() += 1;
  return gained.llt();
}

}  // namespace

Eigen::MatrixXd CovarianceRoot(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

Eigen::MatrixXd CovarianceWith(const Eigen::MatrixXd& root, const Eigen::MatrixXd& information) {
  const Eigen::MatrixXd half = Gained(root, information).matrixL().solve(root.transpose());
  return half.transpose() * half;
}

Eigen::VectorXd VariancesWith(const Eigen::MatrixXd& root, const Eigen::MatrixXd& quantities,
                              const Eigen::MatrixXd& information) {
  const Eigen::MatrixXd across = (quantities * root).transpose();
  return Gained(root, information).matrixL().solve(across).colwise().squaredNorm().transpose();
}

double VarianceInflation(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& information) {
  ExpectSquare(covariance, information);
  constexpr double kTold = 1e-6;  // of the largest eigenvalue: below it, the information tells nothing
  const Eigen::MatrixXd root = CovarianceRoot(information);
  const Eigen::VectorXd size = root.colwise().squaredNorm();
  std::vector<Eigen::Index> told;
  for (Eigen::Index i = 0; i < size.size(); ++i) {
    if (size[i] > kTold * size.maxCoeff()) told.push_back(i);
  }
  if (told.empty()) return 1;
  const Eigen::MatrixXd half = root(Eigen::all, told);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ratios(half.transpose() * covariance * half);
  return std::max(1.0, ratios.eigenvalues()[ratios.eigenvalues().size() / 2]);
}

Eigen::VectorXd TakenRows::SharedPart(double count, const Eigen::VectorXd& sum) const {
  const double row = sigmas_.row * sigmas_.row, patch = sigmas_.patch * sigmas_.patch;
  return std::sqrt(patch / (row + count * patch)) * sum;
}

Eigen::MatrixXd TakenRows::InformationOf(const std::vector<PhotoRow>& photo) const {
  if (photo.empty()) return {};
  // The last parameter is the photo's gain.
  const Eigen::Index parameters = photo.front().derivative.size(), all = parameters + 1;
  Eigen::MatrixXd rows(all, static_cast<Eigen::Index>(photo.size()));
  Eigen::Index used = 0;
  std::map<Cluster, Sums> added;
  for (const PhotoRow& row : photo) {
    if (row.derivative.size() != parameters)
      throw std::invalid_argument("TakenRows: expected rows of equally many parameters");
    if (IsTaken(row)) continue;
    rows.col(used) << row.derivative, 1;
    Sums& sums = added[{row.patch, row.state}];
    if (sums.count == 0) sums.derivative.setZero(all);
    sums.count += rows_per_element_;
    sums.derivative += rows_per_element_ * rows.col(used++);
  }
  if (used == 0) return Eigen::MatrixXd::Zero(parameters, parameters);
  // One product of matrices takes a fraction of the time of as many outer products.
  Eigen::MatrixXd shared_before = Eigen::MatrixXd::Zero(all, static_cast<Eigen::Index>(added.size())),
                  shared_after = shared_before;
  Eigen::Index at = 0;
  for (const auto& [cluster, sums] : added) {
    Eigen::VectorXd before = Eigen::VectorXd::Zero(all);
    const auto known = clusters_.find(cluster);
    const double count = known == clusters_.end() ? 0 : known->second.count;
    if (known != clusters_.end()) before.head(parameters) = known->second.derivative;
    shared_before.col(at) = SharedPart(count, before);
    shared_after.col(at++) = SharedPart(count + sums.count, before + sums.derivative);
  }
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(all, all);
  lower.selfadjointView<Eigen::Lower>().rankUpdate(rows.leftCols(used), rows_per_element_);
  lower.selfadjointView<Eigen::Lower>().rankUpdate(shared_before, 1);
  lower.selfadjointView<Eigen::Lower>().rankUpdate(shared_after, -1);
  Eigen::MatrixXd information = lower.selfadjointView<Eigen::Lower>();
  information /= sigmas_.row * sigmas_.row;
  const Eigen::VectorXd with_gain = information.col(parameters).head(parameters);
  const double gain = information(parameters, parameters) + 1 / (sigmas_.view * sigmas_.view);
  return information.topLeftCorner(parameters, parameters) - with_gain * with_gain.transpose() / gain;
}

void TakenRows::Add(const std::vector<PhotoRow>& photo) {
  for (const PhotoRow& row : photo) {
    if (!taken_.insert({row.element, row.state}).second) continue;
    Sums& sums = clusters_[{row.patch, row.state}];
    if (sums.count == 0) sums.derivative.setZero(row.derivative.size());
    sums.count += rows_per_element_;
    sums.derivative += rows_per_element_ * row.derivative;
  }
}

}  // namespace luxfit
