#include "inverse/model/internal/search/nonnegative_least_squares.h"

#include <Eigen/Cholesky>
#include <stdexcept>
#include <vector>

namespace luxfit {
namespace {

using Indices = std::vector<Eigen::Index>;

// Solves least squares over the unknowns `positive`, scaled to a unit diagonal; the others are 0.
Eigen::VectorXd SolveOver(const Eigen::MatrixXd& gram, const Eigen::VectorXd& moment,
                          const Indices& positive) {
  const Eigen::VectorXd scale = gram.diagonal()(positive).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd own = scale.asDiagonal() * gram(positive, positive) * scale.asDiagonal();
  own.diagonal().array() += 1e-12;  // equal columns share the value of one
  Eigen::VectorXd x = Eigen::VectorXd::Zero(moment.size());
  x(positive) = scale.cwiseProduct(own.ldlt().solve(scale.cwiseProduct(moment(positive))));
  return x;
}

// Goes from `from` towards `to` as far as is feasible. The unknowns that reach 0 there leave `positive`.
Eigen::VectorXd StepBack(const Eigen::VectorXd& from, const Eigen::VectorXd& to, Indices& positive) {
  const auto share = [&](Eigen::Index i) {
    if (to[i] > 0) return 1.0;
    return from[i] > 0 ? from[i] / (from[i] - to[i]) : 0.0;
  };
  double step = 1;
  for (const Eigen::Index i : positive) step = std::min(step, share(i));
  Eigen::VectorXd x = from + step * (to - from);
  Indices kept;
  for (const Eigen::Index i : positive) {
    if (to[i] <= 0 && share(i) <= step) {
      x[i] = 0;
    } else {
      kept.push_back(i);
    }
  }
  positive = kept;
  return x;
}

}  // namespace

Eigen::VectorXd SolveNonNegative(const Eigen::MatrixXd& gram, const Eigen::VectorXd& moment) {
  if (gram.rows() != moment.size() || gram.cols() != moment.size())
    throw std::invalid_argument("SolveNonNegative: expected a square matrix as long as the right-hand side");
  Indices positive;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(moment.size());
  if (moment.size() == 0) return x;
  for (Eigen::Index i = 0; i < moment.size(); ++i) {
    if (!(gram(i, i) > 0)) continue;
    positive.push_back(i);
    x[i] = std::max(moment[i] / gram(i, i), 0.0) + 1e-12;
  }
  const Eigen::VectorXd unit = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  for (Eigen::Index change = 0; change < 3 * moment.size() + 1; ++change) {
    Eigen::VectorXd best = SolveOver(gram, moment, positive);
    while (!positive.empty() && best(positive).minCoeff() <= 0) {  // each round drops at least one
      x = StepBack(x, best, positive);
      best = SolveOver(gram, moment, positive);
    }
    x = best;
    // The gradient says whether an unknown at 0 would rather grow.
    Eigen::VectorXd pull = (moment - gram * x).cwiseProduct(unit);
    for (const Eigen::Index i : positive) pull[i] = 0;
    Eigen::Index most = 0;
    const double tolerance = 1e-10 * moment.cwiseProduct(unit).cwiseAbs().maxCoeff();
    if (pull.size() == 0 || pull.maxCoeff(&most) <= tolerance || !(gram(most, most) > 0)) break;
    positive.push_back(most);
  }
  return x;
}

}  // namespace luxfit
