#include "inverse/choose/internal/detail/ambient_left.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

namespace luxfit {
namespace {

// A share whose sigma is nearly its prior's is told by nothing else.
constexpr double kTold = 0.9;

double Chi2Of95(double freedom) {
  constexpr double kNormal95 = 1.6449;
  const double third = 2 / (9 * freedom);
  return freedom * std::pow(1 - third + kNormal95 * std::sqrt(third), 3);
}

}  // namespace

double AmbientLeft::Spread() const {
  return IsNeeded() ? std::sqrt(share.squaredNorm() / static_cast<double>(share.size())) : 0;
}

AmbientLeft AmbientLeftIn(const LuminaireFit& fit, double prior_sigma) {
  AmbientLeft left;
  if (fit.covariance.rows() != static_cast<Eigen::Index>(fit.parameters.size())) return left;
  std::vector<Eigen::Index> rows;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (fit.parameters[i].kind != ParameterKind::kAmbientShare ||
        !(std::sqrt(fit.covariance(row, row)) < kTold * prior_sigma))
      continue;
    rows.push_back(row);
    left.states.push_back(fit.parameters[i].index);
  }
  if (rows.empty()) return left;
  const Eigen::MatrixXd covariance = fit.covariance(rows, rows);
  left.share = fit.state.ambient_share(left.states);
  left.sigma = covariance.diagonal().cwiseSqrt();
  left.chi2 = left.share.dot(covariance.ldlt().solve(left.share));
  left.chi2_95 = Chi2Of95(static_cast<double>(rows.size()));
  return left;
}

std::vector<Reading> WithAmbientSpread(std::vector<Reading> readings, double spread) {
  for (Reading& reading : readings)
    reading.sigma_lx = std::hypot(reading.sigma_lx, spread * reading.ambient_lx);
  return readings;
}

LightState WithoutAmbientLeft(LightState state) {
  state.ambient_share.setZero();
  state.ambient_shares_free = false;
  return state;
}

}  // namespace luxfit
