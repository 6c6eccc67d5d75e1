#include "inverse/advise/information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <stdexcept>
#include <vector>

namespace luxfit {
namespace {

void ExpectSquare(const Eigen::MatrixXd& root, const Eigen::MatrixXd& information) {
  if (information.rows() != root.rows() || information.cols() != root.rows())
    throw std::invalid_argument("CovarianceWith: expected an information of as many rows as parameters");
}

// Returns the Cholesky factor of 1 + L^T I L.
Eigen::LLT<Eigen::MatrixXd> Gained(const Eigen::MatrixXd& root, const Eigen::MatrixXd& information) {
  ExpectSquare(root, information);
  Eigen::MatrixXd gained = root.transpose() * information * root;
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

Eigen::MatrixXd TakenRows::SharedPart(double count, const Eigen::VectorXd& sum) const {
  const double row = sigmas_.row * sigmas_.row, patch = sigmas_.patch * sigmas_.patch;
  return patch / (row + count * patch) * sum * sum.transpose();
}

Eigen::MatrixXd TakenRows::InformationOf(const std::vector<PhotoRow>& photo) const {
  if (photo.empty()) return {};
  // The last parameter is the photo's gain.
  const Eigen::Index parameters = photo.front().derivative.size(), all = parameters + 1;
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(all, all);
  std::map<Cluster, Sums> added;
  Eigen::VectorXd extended(all);
  extended[parameters] = 1;
  for (const PhotoRow& row : photo) {
    if (row.derivative.size() != parameters)
      throw std::invalid_argument("TakenRows: expected rows of equally many parameters");
    if (IsTaken(row)) continue;
    extended.head(parameters) = row.derivative;
    squares.selfadjointView<Eigen::Lower>().rankUpdate(extended, rows_per_element_);
    Sums& sums = added[{row.patch, row.state}];
    if (sums.count == 0) sums.derivative.setZero(all);
    sums.count += rows_per_element_;
    sums.derivative += rows_per_element_ * extended;
  }
  Eigen::MatrixXd information = squares.selfadjointView<Eigen::Lower>();
  for (const auto& [cluster, sums] : added) {
    Eigen::VectorXd before = Eigen::VectorXd::Zero(all);
    const auto known = clusters_.find(cluster);
    const double count = known == clusters_.end() ? 0 : known->second.count;
    if (known != clusters_.end()) before.head(parameters) = known->second.derivative;
    information += SharedPart(count, before) - SharedPart(count + sums.count, before + sums.derivative);
  }
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
