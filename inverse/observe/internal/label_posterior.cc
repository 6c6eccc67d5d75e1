#include "inverse/observe/internal/label_posterior.h"

#include <cmath>

namespace luxfit {
namespace {

// Returns ln(p e^own + (1 - p) e^other) and, as `share`, the first term's share.
double LogMixture(double p, double own, double other, double& share) {
  const double a = std::log(p) + own, b = std::log1p(-p) + other;
  const double high = std::max(a, b);
  const double sum = std::exp(a - high) + std::exp(b - high);
  share = std::exp(a - high) / sum;
  return high + std::log(sum);
}

}  // namespace

LabelPosterior PosteriorOf(const Eigen::MatrixXd& log_own, const Eigen::MatrixXd& log_other,
                           const Eigen::VectorXd& prior) {
  const Eigen::Index n = prior.size();
  Eigen::MatrixXd share = Eigen::MatrixXd::Ones(n, n);  // (a, b): b shows the element if a does
  Eigen::VectorXd log_weight(n), log_none(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    log_weight[a] = std::log(prior[a]);
    log_none[a] = std::log1p(-prior[a]);
    for (Eigen::Index b = 0; b < n; ++b) {
      if (b == a) continue;
      log_weight[a] += LogMixture(prior[b], log_own(a, b), log_other(a, b), share(a, b));
      log_none[a] += std::log1p(-prior[b]) + log_other(a, b);
    }
    log_weight[a] -= std::log(share.row(a).sum());
  }
  const double high = std::max(log_weight.maxCoeff(), log_none.maxCoeff());
  Eigen::VectorXd weight = (log_weight.array() - high).exp();
  weight /= weight.sum() + (log_none.array() - high).exp().mean();
  return {share.transpose() * weight, weight.asDiagonal() * (1 - share.array()).matrix()};
}

}  // namespace luxfit
