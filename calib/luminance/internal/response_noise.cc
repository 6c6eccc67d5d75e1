#include "calib/luminance/internal/response_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/luminance/internal/response_levels.h"
#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr Eigen::Index kBins = 24;
constexpr size_t kMinResiduals = 30;
constexpr int kNoiseRounds = 4;

Eigen::Index BinOf(double counts, const ResponseOptions& options) {
  const double share = counts / options.full_scale_counts;
  return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(share * kBins), 0, kBins - 1);
}

// Holds |r| and the variance of the mean that r is relative to.
struct AbsoluteResidual {
  double absolute, mean_variance;
};
using ResidualBins = std::vector<std::vector<AbsoluteResidual>>;

void AddResiduals(const Eigen::MatrixXd& counts, const Eigen::VectorXd& log_time, size_t channel,
                  const CameraResponse& response, const ResponseOptions& options,
                  const Eigen::VectorXd& sigma, ResidualBins& bins) {
  struct Entry {
    Eigen::Index bin;
    double log_luminance, weight;
  };
  std::vector<Entry> entries;
  entries.reserve(static_cast<size_t>(counts.cols()));
  for (Eigen::Index i = 0; i < counts.rows(); ++i) {
    entries.clear();
    double weights = 0, sum = 0;
    for (Eigen::Index j = 0; j < counts.cols(); ++j) {
      if (!IsInRange(counts(i, j), options)) continue;
      const Eigen::Index bin = BinOf(counts(i, j), options);
      const double value = std::log(response.Exposure(channel, counts(i, j))) - log_time[j];
      entries.push_back({bin, value, 1 / (sigma[bin] * sigma[bin])});
      weights += entries.back().weight;
      sum += entries.back().weight * value;
    }
    if (entries.size() < 2) continue;
    for (const Entry& e : entries) {
      const double others = weights - e.weight;
      const double mean = (sum - e.weight * e.log_luminance) / others;
      bins[static_cast<size_t>(e.bin)].push_back({std::abs(e.log_luminance - mean), 1 / others});
    }
  }
}

double SigmaOf(std::vector<AbsoluteResidual>& residuals) {
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(
      residuals.begin(), middle, residuals.end(),
      [](const AbsoluteResidual& a, const AbsoluteResidual& b) { return a.absolute < b.absolute; });
  const double total = std::pow(kSigmaPerMad * middle->absolute, 2);
  double mean_variance = 0;
  for (const AbsoluteResidual& r : residuals)
    mean_variance += r.mean_variance / static_cast<double>(residuals.size());
  // Where the noise of the others explains all of it, a tenth is left: no count is perfect.
  return std::sqrt(std::max(total - mean_variance, 0.1 * total));
}

Eigen::VectorXd NextSigma(ResidualBins& bins) {
  Eigen::VectorXd sigma = Eigen::VectorXd::Constant(kBins, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index b = 0; b < kBins; ++b) {
    std::vector<AbsoluteResidual>& residuals = bins[static_cast<size_t>(b)];
    if (residuals.size() >= kMinResiduals) sigma[b] = std::max(1e-4, SigmaOf(residuals));
  }
  for (Eigen::Index b = 1; b < kBins; ++b) {
    if (std::isnan(sigma[b])) sigma[b] = sigma[b - 1];
  }
  for (Eigen::Index b = kBins - 1; b-- > 0;) {
    if (std::isnan(sigma[b])) sigma[b] = sigma[b + 1];
  }
  return sigma;
}

}  // namespace

std::array<Eigen::VectorXd, 3> RelativeSigma(const std::vector<BracketSamples>& brackets,
                                             const CameraResponse& response, const ResponseOptions& options) {
  std::array<Eigen::VectorXd, 3> result;
  for (size_t c = 0; c < 3; ++c) {
    Eigen::VectorXd sigma = Eigen::VectorXd::Constant(kBins, 0.05);
    for (int round = 0; round < kNoiseRounds; ++round) {
      ResidualBins bins(static_cast<size_t>(kBins));
      for (const BracketSamples& bracket : brackets) {
        AddResiduals(bracket.counts[c], bracket.exposure_s.array().log(), c, response, options, sigma, bins);
      }
      const Eigen::VectorXd next = NextSigma(bins);
      if (next.allFinite()) sigma = next;
    }
    result[c].resize(kResponseLevels);
    for (Eigen::Index k = 0; k < kResponseLevels; ++k) {
      const double place = std::clamp((static_cast<double>(k) + 0.5) * kBins / kResponseLevels - 0.5, 0.0,
                                      static_cast<double>(kBins - 1));
      const Eigen::Index below = std::min(static_cast<Eigen::Index>(place), kBins - 2);
      const double share = place - static_cast<double>(below);
      result[c][k] = (1 - share) * sigma[below] + share * sigma[below + 1];
    }
  }
  return result;
}

}  // namespace luxfit
