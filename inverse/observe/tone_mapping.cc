#include "inverse/observe/tone_mapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

constexpr size_t kLeastViews = 3, kLeastElements = 30, kLeastDifferences = 300;
constexpr int kSlopeRounds = 20;

// Holds what two views show of the same elements in one state.
struct PhotoPair {
  int a = 0, b = 0;
  // Differences, a less b.
  std::vector<double> value;
  std::array<std::vector<double>, kSurroundSigmas.size()> surround;
};

using ElementViews = std::map<std::pair<int, int>, std::vector<size_t>>;  // by state and element

std::vector<PhotoPair> PairsOf(const std::vector<Observation>& observations,
                               const std::vector<Surround::Values>& surround,
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
        const Observation &a = observations[seen[m]], &b = observations[seen[n]];
        PhotoPair& pair = pairs[{place.first, a.view, b.view}];
        pair.a = a.view, pair.b = b.view;
        pair.value.push_back(std::log(a.relative_luminance / b.relative_luminance));
        const Surround::Values difference = surround[seen[m]] - surround[seen[n]];
        for (size_t j = 0; j < pair.surround.size(); ++j)
          pair.surround[j].push_back(difference[static_cast<Eigen::Index>(j)]);
      }
    }
  }
  std::vector<PhotoPair> list;
  for (auto& [key, pair] : pairs)
    if (pair.value.size() >= kLeastElements) list.push_back(std::move(pair));
  return list;
}

void TakeMedian(std::vector<double>& values) {
  const double median = Median(values);
  for (double& value : values) value -= median;
}

// Sums of weighed products of one pair of views.
struct Sums {
  int a = 0, b = 0;
  double products = 0, squares = 0;
};

// Returns 1.4826 times the median of what the slope leaves.
double ScaleOf(const std::vector<PhotoPair>& pairs, size_t size, double slope) {
  std::vector<double> left;
  for (const PhotoPair& pair : pairs) {
    for (size_t i = 0; i < pair.value.size(); ++i)
      left.push_back(std::abs(pair.value[i] - slope * pair.surround[size][i]));
  }
  return 1.4826 * Median(std::move(left));
}

std::vector<Sums> SumsAt(const std::vector<PhotoPair>& pairs, size_t size, double slope, double scale) {
  constexpr double kTukey = 4.685;
  std::vector<Sums> sums;
  sums.reserve(pairs.size());
  for (const PhotoPair& pair : pairs) {
    Sums sum{pair.a, pair.b};
    for (size_t i = 0; i < pair.value.size(); ++i) {
      const double x = pair.surround[size][i], z = (pair.value[i] - slope * x) / (kTukey * scale);
      if (std::abs(z) >= 1) continue;
      const double weight = (1 - z * z) * (1 - z * z);
      sum.products += weight * x * pair.value[i];
      sum.squares += weight * x * x;
    }
    sums.push_back(sum);
  }
  return sums;
}

// Returns the slope without the pairs of a view; -1: of all pairs.
double SlopeWithout(const std::vector<Sums>& sums, int view) {
  double products = 0, squares = 0;
  for (const Sums& sum : sums) {
    if (sum.a == view || sum.b == view) continue;
    products += sum.products, squares += sum.squares;
  }
  return squares > 0 ? products / squares : 0;
}

double JackknifeSigma(const std::vector<Sums>& sums, const std::vector<int>& views) {
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

// `size`: of the surroundings, an index into kSurroundSigmas.
ToneMapping BySurround(const std::vector<PhotoPair>& pairs, size_t size) {
  double slope = 0;
  std::vector<Sums> sums;
  for (int round = 0; round < kSlopeRounds; ++round) {
    sums = SumsAt(pairs, size, slope, std::max(ScaleOf(pairs, size, slope), 1e-6));
    const double before = std::exchange(slope, SlopeWithout(sums, -1));
    if (std::abs(slope - before) < 1e-4) break;
  }
  const std::vector<int> views = ViewsOf(pairs);
  return {-slope, JackknifeSigma(sums, views), static_cast<int>(views.size()), ScaleOf(pairs, size, 0),
          ScaleOf(pairs, size, slope)};
}

std::optional<ToneMapping> ToneMappingOf(std::vector<PhotoPair> pairs) {
  size_t differences = 0;
  for (PhotoPair& pair : pairs) {
    TakeMedian(pair.value);
    for (std::vector<double>& surround : pair.surround) TakeMedian(surround);
    differences += pair.value.size();
  }
  if (ViewsOf(pairs).size() < kLeastViews || differences < kLeastDifferences) return std::nullopt;
  const ToneMapping near = BySurround(pairs, 0), far = BySurround(pairs, 1);
  return near.strength * far.sigma >= far.strength * near.sigma ? near : far;
}

}  // namespace

std::vector<std::optional<ToneMapping>> FindToneMapping(const std::vector<Observation>& observations,
                                                        const std::vector<Surround::Values>& surround,
                                                        const std::vector<int>& camera_of_view, int cameras) {
  std::vector<std::optional<ToneMapping>> found;
  found.reserve(static_cast<size_t>(cameras));
  for (int camera = 0; camera < cameras; ++camera)
    found.push_back(ToneMappingOf(PairsOf(observations, surround, camera_of_view, camera)));
  return found;
}

}  // namespace luxfit
