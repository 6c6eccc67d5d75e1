#include "calib/luminance/exposure.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr Eigen::Index kStride = 3;
constexpr size_t kMinPixels = 100;
constexpr double kLeastShare = 0.02;  // of full scale: less is mostly noise
constexpr double kLeastGainSigma = 1e-3;
constexpr int kGainRounds = 30;

}  // namespace

std::optional<ExposureRatio> MeasureRatio(const LuminanceImage& first, double first_exposure_s,
                                          const LuminanceImage& second, double second_exposure_s) {
  if (first.valid.rows() != second.valid.rows() || first.valid.cols() != second.valid.cols())
    throw std::invalid_argument("MeasureRatio: expected images of one size");
  std::vector<double> ratios;
  ratios.reserve(static_cast<size_t>(first.valid.size() / (kStride * kStride)));
  for (Eigen::Index v = 0; v < first.valid.rows(); v += kStride) {
    for (Eigen::Index u = 0; u < first.valid.cols(); u += kStride) {
      if (!first.valid(v, u) || !second.valid(v, u)) continue;
      const double a = first.relative_luminance(v, u), b = second.relative_luminance(v, u);
      if (a * first_exposure_s < kLeastShare || b * second_exposure_s < kLeastShare) continue;
      ratios.push_back(std::log(a / b));
    }
  }
  if (ratios.size() < kMinPixels) return std::nullopt;
  ExposureRatio ratio;
  ratio.pixels = static_cast<int>(ratios.size());
  ratio.log_ratio = Median(ratios);
  for (double& r : ratios) r = std::abs(r - ratio.log_ratio);
  // The standard error of a median is 1.25 times that of a mean.
  const double spread = 1.25 * kSigmaPerMad * Median(ratios) / std::sqrt(static_cast<double>(ratio.pixels));
  ratio.sigma = std::max(kLeastGainSigma, spread);
  return ratio;
}

ExposureGains SolveGains(int photos, const std::vector<ExposureRatio>& ratios,
                         const ExposureGainsOptions& options) {
  Eigen::MatrixXd data = Eigen::MatrixXd::Zero(photos, photos);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(photos);
  for (const ExposureRatio& ratio : ratios) {
    if (ratio.first < 0 || ratio.first >= photos || ratio.second < 0 || ratio.second >= photos ||
        !(ratio.sigma > 0))
      throw std::invalid_argument("SolveGains: expected ratios of known photos with sigmas > 0");
    const double weight = 1 / (ratio.sigma * ratio.sigma);
    data(ratio.first, ratio.first) += weight;
    data(ratio.second, ratio.second) += weight;
    data(ratio.first, ratio.second) -= weight;
    data(ratio.second, ratio.first) -= weight;
    right[ratio.first] += weight * ratio.log_ratio;
    right[ratio.second] -= weight * ratio.log_ratio;
  }
  ExposureGains gains;
  gains.log_gain = Eigen::VectorXd::Zero(photos);
  gains.sigma = Eigen::VectorXd::Constant(photos, options.prior);
  if (photos == 0) return gains;
  Eigen::VectorXd prior = Eigen::VectorXd::Constant(photos, 1 / (options.prior * options.prior));
  Eigen::MatrixXd normal;
  for (int round = 0; round < kGainRounds; ++round) {
    normal = data;
    normal.diagonal() += prior;
    gains.log_gain = normal.ldlt().solve(right);
    prior = 1 / (options.prior * options.prior + gains.log_gain.array().square());
  }
  gains.sigma = normal.ldlt().solve(Eigen::MatrixXd::Identity(photos, photos)).diagonal().cwiseSqrt();
  for (int i = 0; i < photos; ++i) {
    const double delta = std::abs(gains.log_gain[i]);
    if (delta > options.least && delta > 4 * gains.sigma[i]) gains.off.push_back(i);
  }
  return gains;
}

}  // namespace luxfit
