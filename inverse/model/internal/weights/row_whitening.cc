#include "inverse/model/internal/weights/row_whitening.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

namespace luxfit {
namespace {

// Returns (1 - (1 + l)^(-1/2)) / l, exact for small l as well.
double FactorOf(double l) {
  const double root = std::sqrt(1 + l);
  return 1 / (root * (1 + root));
}

}  // namespace

void RowWhitening::Add(const std::vector<Eigen::Index>& rows, const std::vector<double>& effect) {
  double squares = 0;
  for (const double u : effect) squares += u * u;
  if (squares == 0) return;
  singles_.push_back({row_.size(), rows.size(), squares});
  row_.insert(row_.end(), rows.begin(), rows.end());
  effect_.insert(effect_.end(), effect.begin(), effect.end());
}

Eigen::RowVectorXd RowWhitening::Block::Turned(Eigen::Index row) const {
  return effect.row(row) * turned.middleRows(owner[static_cast<size_t>(row)] * effect.cols(), effect.cols());
}

void RowWhitening::Add(Eigen::Index first, const Eigen::MatrixXd& effect, const std::vector<int>& owner,
                       const Eigen::MatrixXd& root) {
  if (effect.size() == 0 || root.size() == 0) return;
  const Eigen::Index p = effect.cols();
  std::vector<Eigen::MatrixXd> information(static_cast<size_t>(root.rows() / p), Eigen::MatrixXd::Zero(p, p));
  for (Eigen::Index i = 0; i < effect.rows(); ++i)
    information[static_cast<size_t>(owner[static_cast<size_t>(i)])] +=
        effect.row(i).transpose() * effect.row(i);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(root.cols(), root.cols());
  for (size_t k = 0; k < information.size(); ++k) {
    const auto own = root.middleRows(static_cast<Eigen::Index>(k) * p, p);
    squares.noalias() += own.transpose() * information[k] * own;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(squares);
  blocks_.push_back({first, effect, owner, root * eigen.eigenvectors(), eigen.eigenvalues().cwiseMax(0)});
}

template <typename Matrix>
void RowWhitening::ApplyTo(Matrix& rows) const {
  for (const Single& group : singles_) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(rows.cols());
    for (size_t i = group.first; i < group.first + group.count; ++i) sum += effect_[i] * rows.row(row_[i]);
    sum *= FactorOf(group.squares);
    for (size_t i = group.first; i < group.first + group.count; ++i) rows.row(row_[i]) -= effect_[i] * sum;
  }
  for (const Block& block : blocks_) {
    const Eigen::Index p = block.effect.cols();
    Rows by_owner = Rows::Zero(block.turned.rows(), rows.cols());
    for (Eigen::Index i = 0; i < block.effect.rows(); ++i)
      by_owner.middleRows(block.owner[static_cast<size_t>(i)] * p, p).noalias() +=
          block.effect.row(i).transpose() * rows.row(block.first + i);
    const Eigen::VectorXd factor = block.squares.unaryExpr(&FactorOf);
    by_owner = block.turned * (factor.asDiagonal() * (block.turned.transpose() * by_owner)).eval();
    for (Eigen::Index i = 0; i < block.effect.rows(); ++i)
      rows.row(block.first + i).noalias() -=
          block.effect.row(i) * by_owner.middleRows(block.owner[static_cast<size_t>(i)] * p, p);
  }
}

void RowWhitening::Apply(Rows& rows) const { ApplyTo(rows); }
void RowWhitening::Apply(Eigen::VectorXd& rows) const { ApplyTo(rows); }

Eigen::VectorXd RowWhitening::Remainder(Eigen::VectorXd rows) const {
  Apply(rows);
  Apply(rows);
  return rows;
}

Eigen::VectorXd RowWhitening::RemainingVariance(Eigen::Index rows) const {
  Eigen::VectorXd remaining = Eigen::VectorXd::Ones(rows);
  for (const Single& group : singles_) {
    for (size_t i = group.first; i < group.first + group.count; ++i)
      remaining[row_[i]] -= effect_[i] * effect_[i] / (1 + group.squares);
  }
  for (const Block& block : blocks_) {
    const Eigen::VectorXd share = (1 + block.squares.array()).inverse();
    for (Eigen::Index i = 0; i < block.effect.rows(); ++i)
      remaining[block.first + i] -= block.Turned(i).cwiseAbs2() * share;
  }
  return remaining;
}

}  // namespace luxfit
