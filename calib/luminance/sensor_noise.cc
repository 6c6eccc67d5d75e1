#include "calib/luminance/sensor_noise.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr size_t kMinPairs = 2000;
constexpr size_t kPairBins = 20;

struct Bin {
  double variance = 0;                      // variance of the difference
  double read_factor = 0, shot_factor = 0;  // variance = read^2 * read_factor + shot * shot_factor
};

// Returns the bin of the pairs [first, last), which have similar luminance.
Bin BinOf(const std::vector<NoisePair>& pairs, size_t first, size_t last, double t1, double t2) {
  std::vector<double> difference;
  difference.reserve(last - first);
  double sum1 = 0, sum2 = 0;
  for (size_t i = first; i < last; ++i) {
    difference.push_back(pairs[i].first / t1 - pairs[i].second / t2);
    sum1 += pairs[i].first;
    sum2 += pairs[i].second;
  }
  const double center = Median(difference);
  for (double& d : difference) d = std::abs(d - center);
  const double sigma = kSigmaPerMad * Median(difference);
  const double count = static_cast<double>(last - first);
  return {sigma * sigma, 1 / (t1 * t1) + 1 / (t2 * t2), sum1 / count / (t1 * t1) + sum2 / count / (t2 * t2)};
}

}  // namespace

SensorNoise DefaultNoise(int bits_per_channel) {
  SensorNoise noise;
  if (bits_per_channel == 8) {
    noise.read = 1.0 / 255;
    noise.shot = 0;
  }
  return noise;
}

std::optional<SensorNoise> EstimateNoise(const std::vector<NoisePair>& pairs, double first_exposure,
                                         double second_exposure) {
  if (!(first_exposure > 0) || !(second_exposure > 0))
    throw std::invalid_argument("EstimateNoise: expected exposures > 0");
  if (pairs.size() < kMinPairs) return std::nullopt;
  std::vector<NoisePair> sorted = pairs;
  // Sorting by a quantity that correlates with the difference would cut its noise. This one is uncorrelated
  // with it in the dark, where bins are narrow against the noise.
  std::sort(sorted.begin(), sorted.end(), [&](const NoisePair& p, const NoisePair& q) {
    return first_exposure * p.first + second_exposure * p.second <
           first_exposure * q.first + second_exposure * q.second;
  });
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (size_t b = 0; b < kPairBins; ++b) {
    const Bin bin = BinOf(sorted, b * sorted.size() / kPairBins, (b + 1) * sorted.size() / kPairBins,
                          first_exposure, second_exposure);
    if (!(bin.variance > 0)) continue;
    // The standard error of a variance is proportional to the variance: weight each row by its inverse.
    const Eigen::Vector2d row(bin.read_factor / bin.variance, bin.shot_factor / bin.variance);
    normal += row * row.transpose();
    right += row;
  }
  if (!(normal(0, 0) > 0)) return std::nullopt;
  Eigen::Vector2d solution = Eigen::Vector2d::Zero();
  if (normal.determinant() > 1e-9 * normal(0, 0) * normal(1, 1)) solution = normal.inverse() * right;
  if (!(solution[0] > 0)) solution = {0, right[1] / normal(1, 1)};
  if (!(solution[1] >= 0)) solution = {right[0] / normal(0, 0), 0};
  if (!solution.allFinite() || !(solution.sum() > 0)) return std::nullopt;
  return SensorNoise{std::sqrt(solution[0]), solution[1]};
}

}  // namespace luxfit
