#include "inverse/observe/camera/internal/view_slope.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr size_t kLeastViews = 3, kLeastElements = 30, kLeastDifferences = 300;
constexpr int kSlopeRounds = 20;

using ElementViews = std::map<std::pair<int, int>, std::vector<size_t>>;  // by state and element

void TakeMedian(std::vector<double>& values) {
  const double median = Median(values);
  for (double& value : values) value -= median;
}

// Sums of weighed products of one pair of views.
struct PairSums {
  int a = 0, b = 0;
  double products = 0, squares = 0;
};

struct Differences {
  const std::vector<PhotoPair>& pairs;
  std::vector<std::vector<double>> y, x;
};

// Returns 1.4826 times the median of what the slope leaves.
double ScaleOf(const Differences& of, double slope) {
  std::vector<double> left;
  for (size_t p = 0; p < of.pairs.size(); ++p)
    for (size_t i = 0; i < of.y[p].size(); ++i) left.push_back(std::abs(of.y[p][i] - slope * of.x[p][i]));
  return kSigmaPerMad * Median(std::move(left));
}

std::vector<PairSums> SumsAt(const Differences& of, double slope, double scale) {
  constexpr double kTukey = 4.685;
  std::vector<PairSums> sums;
  sums.reserve(of.pairs.size());
  for (size_t p = 0; p < of.pairs.size(); ++p) {
    PairSums sum{of.pairs[p].a, of.pairs[p].b};
    for (size_t i = 0; i < of.y[p].size(); ++i) {
      const double x = of.x[p][i], z = (of.y[p][i] - slope * x) / (kTukey * scale);
      if (std::abs(z) >= 1) continue;
      const double weight = (1 - z * z) * (1 - z * z);
      sum.products += weight * x * of.y[p][i];
      sum.squares += weight * x * x;
    }
    sums.push_back(sum);
  }
  return sums;
}

// Returns the slope without the pairs of a view; -1: of all pairs.
double SlopeWithout(const std::vector<PairSums>& sums, int view) {
  double products = 0, squares = 0;
  for (const PairSums& sum : sums) {
    if (sum.a == view || sum.b == view) continue;
    products += sum.products, squares += sum.squares;
  }
  return squares > 0 ? products / squares : 0;
}

double JackknifeSigma(const std::vector<PairSums>& sums, const std::vector<int>& views) {
  const auto n = static_cast<double>(views.size());
  double mean = 0, squares = 0;
  for (const int view : views) mean += SlopeWithout(sums, view) / n;
  for (const int view : views) squares += std::pow(SlopeWithout(sums, view) - mean, 2);
  return std::sqrt((n - 1) / n * squares);
}

std::vector<int> ViewsOf(const std::vector<PhotoPair>& pairs) {
  std::vector<int> views;
  views.reserve(2 * pairs.size());
  for (const PhotoPair& pair : pairs) views.push_back(pair.a), views.push_back(pair.b);
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}

}  // namespace

std::vector<PhotoPair> PairViews(const std::vector<Observation>& observations,
                                 const std::vector<int>& camera_of_view, int camera) {
  ElementViews views;
  for (size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    if (camera_of_view[static_cast<size_t>(o.view)] == camera) views[{o.state, o.element}].push_back(i);
  }
  std::map<std::tuple<int, int, int>, PhotoPair> pairs;
  for (const auto& [place, seen] : views) {
    for (size_t m = 0; m < seen.size(); ++m) {
      for (size_t n = m + 1; n < seen.size(); ++n) {
        const int a = observations[seen[m]].view, b = observations[seen[n]].view;
        PhotoPair& pair = pairs[{place.first, a, b}];
        pair.a = a, pair.b = b, pair.state = place.first;
        pair.shared.emplace_back(seen[m], seen[n]);
      }
    }
  }
  std::vector<PhotoPair> list;
  for (auto& [key, pair] : pairs)
    if (pair.shared.size() >= kLeastElements) list.push_back(std::move(pair));
  return list;
}

std::vector<double> LogRatios(const PhotoPair& pair, const std::vector<Observation>& observations) {
  std::vector<double> ratios;
  ratios.reserve(pair.shared.size());
  for (const auto& [a, b] : pair.shared)
    ratios.push_back(std::log(observations[a].relative_luminance / observations[b].relative_luminance));
  return ratios;
}

std::optional<ViewSlope> SlopeOverViews(const std::vector<PhotoPair>& pairs,
                                        std::vector<std::vector<double>> y,
                                        std::vector<std::vector<double>> x, double tolerance) {
  const std::vector<int> views = ViewsOf(pairs);
  size_t differences = 0;
  for (const PhotoPair& pair : pairs) differences += pair.shared.size();
  if (views.size() < kLeastViews || differences < kLeastDifferences) return std::nullopt;
  for (std::vector<double>& values : y) TakeMedian(values);
  for (std::vector<double>& values : x) TakeMedian(values);
  const Differences of{pairs, std::move(y), std::move(x)};
  double slope = 0;
  std::vector<PairSums> sums;
  for (int round = 0; round < kSlopeRounds; ++round) {
    sums = SumsAt(of, slope, std::max(ScaleOf(of, slope), 1e-6));
    const double before = std::exchange(slope, SlopeWithout(sums, -1));
    if (std::abs(slope - before) < tolerance) break;
  }
  return ViewSlope{slope, JackknifeSigma(sums, views), static_cast<int>(views.size()), ScaleOf(of, 0),
                   ScaleOf(of, slope)};
}

}  // namespace luxfit
