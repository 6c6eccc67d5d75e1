#include "calib/estimate_response.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <tuple>
#include <utility>

#include "calib/internal/response_levels.h"
#include "calib/internal/response_noise.h"

namespace luxfit {
namespace {

using Solver = std::function<CameraResponse(const std::vector<BracketSamples>&)>;

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

// Errors in counts of one exposure predicted from the others.
struct ErrorSum {
  double sum = 0, count = 0;
  double Mean() const { return count > 0 ? sum / count : 0; }
};

// Their means fold by fold: errors within a fold are no independent evidence.
struct HeldOutErrors {
  Eigen::VectorXd of_fold;
  double Mean() const { return of_fold.size() > 0 ? of_fold.mean() : 0; }
  double StandardError() const {
    const double folds = static_cast<double>(of_fold.size());
    return folds > 1 ? std::sqrt((of_fold.array() - Mean()).square().sum() / (folds - 1) / folds) : 0;
  }
};

ErrorSum PredictionError(const CameraResponse& response, const BracketSamples& bracket, Eigen::Index left_out,
                         const ResponseOptions& options) {
  ErrorSum error;
  for (size_t c = 0; c < 3; ++c) {
    const Eigen::MatrixXd& counts = bracket.counts[c];
    for (Eigen::Index i = 0; i < counts.rows(); ++i) {
      if (!IsInRange(counts(i, left_out), options)) continue;
      double top = 0, bottom = 0;
      for (Eigen::Index j = 0; j < counts.cols(); ++j) {
        if (j == left_out || !IsInRange(counts(i, j), options)) continue;
        // Equal noise of counts: the weight of ln E is the inverse square of d ln f / d count.
        const double exposure = response.Exposure(c, counts(i, j));
        const double slope = response.Slope(c, counts(i, j)) / exposure;
        top += std::log(exposure / bracket.exposure_s[j]) / (slope * slope);
        bottom += 1 / (slope * slope);
      }
      if (!(bottom > 0)) continue;
      const double predicted = response.Counts(c, std::exp(top / bottom) * bracket.exposure_s[left_out]);
      error.sum += std::abs(predicted - counts(i, left_out));
      error.count += 1;
    }
  }
  return error;
}

// Exposures between the shortest and the longest of a bracket; all where there are three.
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

HeldOutErrors HeldOut(const std::vector<BracketSamples>& brackets, const ResponseOptions& options,
                      const Solver& solve) {
  size_t folds = 0;
  for (const BracketSamples& bracket : brackets) folds = std::max(folds, InnerExposures(bracket).size());
  HeldOutErrors errors;
  errors.of_fold.resize(static_cast<Eigen::Index>(folds));
  for (size_t fold = 0; fold < folds; ++fold) {
    std::vector<BracketSamples> training;
    training.reserve(brackets.size());
    for (const BracketSamples& bracket : brackets) {
      const std::vector<Eigen::Index> inner = InnerExposures(bracket);
      training.push_back(inner.empty() ? bracket : WithoutExposure(bracket, inner[fold % inner.size()]));
    }
    const CameraResponse response = solve(training);
    ErrorSum total;
    for (const BracketSamples& bracket : brackets) {
      const std::vector<Eigen::Index> inner = InnerExposures(bracket);
      if (inner.empty()) continue;
      const ErrorSum error = PredictionError(response, bracket, inner[fold % inner.size()], options);
      total.sum += error.sum;
      total.count += error.count;
    }
    errors.of_fold[static_cast<Eigen::Index>(fold)] = total.Mean();
  }
  return errors;
}

CameraResponse LinearResponse(const ResponseOptions& options) {
  const Eigen::Vector2d counts(0, options.full_scale_counts), exposure(0, 1);
  return {counts, {exposure, exposure, exposure}};
}

// Why these samples determine no response; empty where they do.
std::string Lack(const std::vector<BracketSamples>& brackets, const ResponseOptions& options) {
  Eigen::Index exposures = 0;
  double ratio = 1;
  bool overlaps = false;
  for (const BracketSamples& bracket : brackets) {
    if (bracket.exposure_s.size() < 3) continue;
    exposures = std::max(exposures, bracket.exposure_s.size());
    ratio = std::max(ratio, bracket.exposure_s.maxCoeff() / bracket.exposure_s.minCoeff());
    for (Eigen::Index i = 0; i < bracket.counts[1].rows() && !overlaps; ++i) {
      Eigen::Index in_range = 0;
      for (Eigen::Index j = 0; j < bracket.counts[1].cols(); ++j)
        in_range += IsInRange(bracket.counts[1](i, j), options) ? 1 : 0;
      overlaps = in_range > 1;
    }
  }
  if (exposures < 3) return "no view has three exposures of one state";
  if (ratio < 2) return "exposures differ by less than a factor of two";
  return overlaps ? "" : "no surface is well exposed in two exposures";
}

}  // namespace

ResponseEstimate EstimateResponse(const std::vector<BracketSamples>& brackets,
                                  const ResponseOptions& options) {
  ResponseEstimate estimate;
  estimate.message = Lack(brackets, options);
  if (!estimate.message.empty()) return estimate;
  std::vector<std::pair<std::string, Solver>> solvers;
  for (const double smoothing : {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5}) {
    std::array<char, 64> name{};
    std::snprintf(name.data(), name.size(), "debevec, smoothing %g", smoothing);
    solvers.push_back({name.data(), [&options, smoothing](const std::vector<BracketSamples>& training) {
                         return SolveDebevec(training, options, {smoothing});
                       }});
  }
  solvers.push_back({"robertson", [&options](const std::vector<BracketSamples>& training) {
                       return SolveRobertson(training, options);
                     }});
  estimate.scores.reserve(solvers.size());
  std::vector<HeldOutErrors> errors;
  errors.reserve(solvers.size());
  for (const auto& [name, solve] : solvers) {
    errors.push_back(HeldOut(brackets, options, solve));
    estimate.scores.push_back({name, errors.back().Mean()});
  }
  estimate.linear_error_counts = HeldOut(brackets, options, [&](const std::vector<BracketSamples>&) {
                                   return LinearResponse(options);
                                 }).Mean();
  const auto best =
      std::min_element(errors.begin(), errors.end(),
                       [](const HeldOutErrors& a, const HeldOutErrors& b) { return a.Mean() < b.Mean(); });
  const double limit = best->Mean() + best->StandardError();
  estimate.chosen = static_cast<size_t>(
      std::find_if(errors.begin(), errors.end(), [&](const HeldOutErrors& e) { return e.Mean() <= limit; }) -
      errors.begin());
  const CameraResponse response = solvers[estimate.chosen].second(brackets);
  estimate.response = response.WithRelativeSigma(RelativeSigma(brackets, response, options));
  return estimate;
}

std::vector<PixelPlace> ChooseSamplePixels(const Photo& photo, size_t count, const ResponseOptions& options,
                                           const PixelMask& allowed) {
  constexpr int kRadius = 2;
  constexpr size_t kBins = 32;
  struct Candidate {
    float spread;
    PixelPlace place;
  };
  std::array<std::vector<Candidate>, kBins> bins;
  const ImagePlane& green = photo.rgb_counts[1];
  // Every third pixel: neighbours say the same.
  for (int v = kRadius; v + kRadius < photo.height_px(); v += 3) {
    for (int u = kRadius; u + kRadius < photo.width_px(); u += 3) {
      if (!IsInRange(green(v, u), options)) continue;
      const Eigen::Index size = 2 * kRadius + 1;
      if (allowed.size() > 0 && !allowed.block(v - kRadius, u - kRadius, size, size).all()) continue;
      const auto around = green.block(v - kRadius, u - kRadius, size, size);
      const size_t bin = std::min(kBins - 1, static_cast<size_t>(green(v, u) / options.full_scale_counts *
                                                                 static_cast<double>(kBins)));
      bins[bin].push_back({around.maxCoeff() - around.minCoeff(), {u, v}});
    }
  }
  std::vector<PixelPlace> places;
  places.reserve(count);
  for (std::vector<Candidate>& bin : bins) {
    const size_t taken = std::min(bin.size(), std::max<size_t>(1, count / kBins));
    std::partial_sort(bin.begin(), bin.begin() + static_cast<std::ptrdiff_t>(taken), bin.end(),
                      [](const Candidate& a, const Candidate& b) {
                        return std::tie(a.spread, a.place.v, a.place.u) <
                               std::tie(b.spread, b.place.v, b.place.u);
                      });
    for (size_t i = 0; i < taken; ++i) places.push_back(bin[i].place);
  }
  return places;
}

Eigen::MatrixX3d CountsAt(const Photo& photo, const std::vector<PixelPlace>& places) {
  Eigen::MatrixX3d counts(static_cast<Eigen::Index>(places.size()), 3);
  for (size_t i = 0; i < places.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      const auto around = photo.rgb_counts[c].block<3, 3>(places[i].v - 1, places[i].u - 1);
      counts(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = static_cast<double>(around.mean());
    }
  }
  return counts;
}

}  // namespace luxfit
