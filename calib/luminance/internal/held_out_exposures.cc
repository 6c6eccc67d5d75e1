#include "calib/luminance/internal/held_out_exposures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/luminance/internal/response_levels.h"

namespace luxfit {
namespace {

BracketSamples WithoutExposure(const BracketSamples& bracket, Eigen::Index left_out) {
  const Eigen::Index others = bracket.exposure_s.size() - 1;
  BracketSamples rest;
  rest.exposure_s.resize(others);
  for (Eigen::MatrixXd& counts : rest.counts) counts.resize(bracket.counts[0].rows(), others);
  for (Eigen::Index j = 0, at = 0; j <= others; ++j) {
    if (j == left_out) continue;
    rest.exposure_s[at] = bracket.exposure_s[j];
    for (size_t c = 0; c < 3; ++c) rest.counts[c].col(at) = bracket.counts[c].col(j);
    ++at;
  }
  return rest;
}

// Returns the mean absolute error, in counts, of one exposure predicted from the others; NaN where nothing
// can be predicted.
double PredictionError(const CameraResponse& response, const BracketSamples& bracket, Eigen::Index left_out,
                       const ResponseOptions& options) {
  double sum = 0, count = 0;
  for (size_t c = 0; c < 3; ++c) {
    const Eigen::MatrixXd& counts = bracket.counts[c];
    for (Eigen::Index i = 0; i < counts.rows(); ++i) {
      if (!IsInRange(counts(i, left_out), options)) continue;
      double top = 0, bottom = 0;
      for (Eigen::Index j = 0; j < counts.cols(); ++j) {
        if (j == left_out || !IsInRange(counts(i, j), options)) continue;
        // With equal noise of counts, the weight of ln E is the inverse square of d ln f / d count.
        const double exposure = response.Exposure(c, counts(i, j));
        const double slope = response.Slope(c, counts(i, j)) / exposure;
        top += std::log(exposure / bracket.exposure_s[j]) / (slope * slope);
        bottom += 1 / (slope * slope);
      }
      if (!(bottom > 0)) continue;
      const double predicted = response.Counts(c, std::exp(top / bottom) * bracket.exposure_s[left_out]);
      sum += std::abs(predicted - counts(i, left_out));
      count += 1;
    }
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

BracketSamples EverySecondPixel(const BracketSamples& bracket, Eigen::Index first) {
  BracketSamples half;
  half.exposure_s = bracket.exposure_s;
  for (size_t c = 0; c < 3; ++c) {
    const Eigen::MatrixXd& counts = bracket.counts[c];
    half.counts[c] = counts(Eigen::seq(first, Eigen::last, Eigen::fix<2>), Eigen::all);
  }
  return half;
}

// Each half of the pixels predicts, by the response of the other half, its exposures from one another.
Eigen::ArrayXd ErrorsOfHalves(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                              const ResponseSolver& solve) {
  std::vector<double> errors;
  for (const Eigen::Index half : {0, 1}) {
    std::vector<BracketSamples> training;
    training.reserve(brackets.size());
    for (const BracketSamples& bracket : brackets) training.push_back(EverySecondPixel(bracket, 1 - half));
    const CameraResponse response = solve(training);
    for (const BracketSamples& bracket : brackets) {
      const BracketSamples rest = EverySecondPixel(bracket, half);
      for (Eigen::Index j = 0; j < rest.exposure_s.size(); ++j)
        errors.push_back(PredictionError(response, rest, j, options));
    }
  }
  return Eigen::Map<const Eigen::ArrayXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

// Returns the exposures between the shortest and the longest of a bracket; all of them where there are at
// most three.
std::vector<Eigen::Index> InnerExposures(const BracketSamples& bracket) {
  Eigen::Index shortest = 0, longest = 0;
  bracket.exposure_s.minCoeff(&shortest);
  bracket.exposure_s.maxCoeff(&longest);
  std::vector<Eigen::Index> inner;
  for (Eigen::Index j = 0; j < bracket.exposure_s.size(); ++j) {
    if (bracket.exposure_s.size() < 4 || (j != shortest && j != longest)) inner.push_back(j);
  }
  return inner;
}

}  // namespace

bool AreOnlyPairs(const std::vector<BracketSamples>& brackets) {
  return std::all_of(brackets.begin(), brackets.end(),
                     [](const BracketSamples& bracket) { return bracket.exposure_s.size() < 3; });
}

Eigen::ArrayXd HeldOutErrors(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                             const ResponseSolver& solve) {
  if (AreOnlyPairs(brackets)) return ErrorsOfHalves(brackets, options, solve);
  size_t folds = 0;
  for (const BracketSamples& bracket : brackets) folds = std::max(folds, InnerExposures(bracket).size());
  std::vector<double> errors;
  errors.reserve(folds * brackets.size());
  for (size_t fold = 0; fold < folds; ++fold) {
    std::vector<BracketSamples> training;
    training.reserve(brackets.size());
    for (const BracketSamples& bracket : brackets) {
      const std::vector<Eigen::Index> inner = InnerExposures(bracket);
      training.push_back(inner.empty() ? bracket : WithoutExposure(bracket, inner[fold % inner.size()]));
    }
    const CameraResponse response = solve(training);
    for (const BracketSamples& bracket : brackets) {
      const std::vector<Eigen::Index> inner = InnerExposures(bracket);
      if (fold < inner.size()) errors.push_back(PredictionError(response, bracket, inner[fold], options));
    }
  }
  return Eigen::Map<const Eigen::ArrayXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

double MeanError(const Eigen::ArrayXd& errors) {
  double sum = 0, count = 0;
  for (const double error : errors) {
    if (std::isnan(error)) continue;
    sum += error;
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

size_t SimplestOfBest(const std::vector<Eigen::ArrayXd>& errors) {
  const auto best = std::min_element(
      errors.begin(), errors.end(),
      [](const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) { return MeanError(a) < MeanError(b); });
  const double mean = MeanError(*best), count = static_cast<double>((*best == *best).count());
  const double spread = MeanError((*best - mean).square());
  const double limit = mean + (count > 1 ? std::sqrt(spread / (count - 1)) : 0);
  const auto chosen = std::find_if(errors.begin(), errors.end(),
                                   [&](const Eigen::ArrayXd& e) { return MeanError(e) <= limit; });
  return static_cast<size_t>(chosen - errors.begin());
}

}  // namespace luxfit
