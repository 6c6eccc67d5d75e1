#include "inverse/control/dimming.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calib/luminance/median.h"
#include "inverse/model/internal/search/nonnegative_least_squares.h"

namespace luxfit {
namespace {

// Models and rooms differ by this much even where a fit is good. No element is weighted by a smaller sigma.
constexpr double kLeastRelativeSigma = 0.01;
constexpr double kLeastSigmaLx = 0.05;

struct DimmingRows {
  Eigen::MatrixXd light;     // rows / sigma
  Eigen::VectorXd measured;  // likewise
  Eigen::VectorXd sigma;
};

DimmingRows RowsOf(const Eigen::MatrixXd& element_lx, const std::vector<ElementIlluminance>& measured) {
  const Eigen::Index rows = static_cast<Eigen::Index>(measured.size());
  DimmingRows weighted{Eigen::MatrixXd(rows, element_lx.cols()), Eigen::VectorXd(rows),
                       Eigen::VectorXd(rows)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const ElementIlluminance& e = measured[static_cast<size_t>(i)];
    if (e.element < 0 || e.element >= element_lx.rows())
      throw std::invalid_argument("EstimateDimming: expected elements of the room");
    if (!(e.random_sigma_lx >= 0))
      throw std::invalid_argument("EstimateDimming: expected sigmas that are not negative");
    const double sigma = std::hypot(e.random_sigma_lx, kLeastRelativeSigma * e.illuminance_lx, kLeastSigmaLx);
    weighted.sigma[i] = sigma;
    weighted.light.row(i) = element_lx.row(e.element) / sigma;
    weighted.measured[i] = e.illuminance_lx / sigma;
  }
  return weighted;
}

// Elements of one surface share the model's error there: this many of them count as one.
constexpr double kElementsPerIndependent = 25;

}  // namespace

CurrentDimming EstimateDimming(const Eigen::MatrixXd& element_lx,
                               const std::vector<ElementIlluminance>& measured) {
  const Eigen::Index luminaires = element_lx.cols();
  CurrentDimming current;
  current.elements = static_cast<int>(measured.size());
  current.dimming = Eigen::VectorXd::Zero(luminaires);
  current.covariance = Eigen::MatrixXd::Zero(luminaires, luminaires);
  const DimmingRows rows = RowsOf(element_lx, measured);
  if (rows.measured.size() <= luminaires) return current;
  const Eigen::MatrixXd gram = rows.light.transpose() * rows.light;
  const Eigen::LDLT<Eigen::MatrixXd> factored(gram);
  if (factored.info() != Eigen::Success ||
      !(factored.vectorD().minCoeff() > 1e-9 * gram.diagonal().maxCoeff()))
    return current;
  current.is_determined = true;
  current.dimming = SolveNonNegative(gram, rows.light.transpose() * rows.measured);
  const Eigen::VectorXd residual = rows.measured - rows.light * current.dimming;
  const Eigen::VectorXd size = residual.cwiseAbs();
  current.residual_scale = kSigmaPerMad * Quantile({size.begin(), size.end()}, 0.5);
  const double variance = std::max(1.0, current.residual_scale * current.residual_scale);
  current.covariance =
      kElementsPerIndependent * variance * factored.solve(Eigen::MatrixXd::Identity(luminaires, luminaires));
  const Eigen::VectorXd residual_lx = residual.cwiseProduct(rows.sigma);
  current.mean_unexplained_lx = residual_lx.mean();
  const double sum_lx = rows.measured.cwiseProduct(rows.sigma).cwiseAbs().sum();
  current.unexplained_share = sum_lx > 0 ? residual_lx.cwiseAbs().sum() / sum_lx : 0;
  return current;
}

std::vector<PlaceIlluminance> LightByDimming(const Eigen::MatrixXd& place_lx, const CurrentDimming& current,
                                             const Eigen::MatrixXd& log_flux_covariance,
                                             double relative_model_sigma) {
  std::vector<PlaceIlluminance> places(static_cast<size_t>(place_lx.rows()));
  for (Eigen::Index i = 0; i < place_lx.rows(); ++i) {
    const Eigen::VectorXd g = place_lx.row(i), lit = g.cwiseProduct(current.dimming);
    const double lx = lit.sum(), model = relative_model_sigma * lx;
    const double variance = g.dot(current.covariance * g) + lit.dot(log_flux_covariance * lit) +
                            model * model + current.mean_unexplained_lx * current.mean_unexplained_lx;
    places[static_cast<size_t>(i)] = {lx, std::sqrt(std::max(variance, 0.0))};
  }
  return places;
}

}  // namespace luxfit
