#include "inverse/observe/observe.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/luminance/median.h"

#include "inverse/observe/internal/between_views.h"

namespace luxfit {
namespace {

std::vector<double> LuminancesOf(const std::vector<Observation>& views) {
  std::vector<double> values;
  values.reserve(views.size());
  for (const Observation& o : views) values.push_back(o.relative_luminance);
  return values;
}

// Leaves out the views far from the median, and returns how many. Of two, nobody knows which is wrong.
int RemoveOutliers(double outlier_sigmas, std::vector<Observation>& views) {
  if (views.size() < 3) return 0;
  const double median = Quantile(LuminancesOf(views), 0.5);  // one of the views, so that one stays
  const auto end = std::remove_if(views.begin(), views.end(), [&](const Observation& o) {
    return std::abs(o.relative_luminance - median) > outlier_sigmas * std::sqrt(o.variance);
  });
  const auto removed = static_cast<int>(views.end() - end);
  views.erase(end, views.end());
  return removed;
}

}  // namespace

MergedObservations MergeViews(const std::vector<Observation>& observations,
                              const MergeViewsOptions& options) {
  MergedObservations merged;
  if (options.relative_sigma) {
    merged.between_views.relative_sigma = *options.relative_sigma;
  } else {
    merged.between_views = EstimateBetweenViews(observations);
    double& sigma = merged.between_views.relative_sigma;
    sigma = std::max(sigma, options.least_relative_sigma);
  }
  std::map<std::pair<int, int>, std::vector<Observation>> groups;  // by element, state
  for (const Observation& o : observations) groups[{o.element, o.state}].push_back(o);
  for (auto& [key, views] : groups) {
    const double component = std::pow(merged.between_views.relative_sigma * Median(LuminancesOf(views)), 2);
    for (Observation& o : views) o.variance += component;
    merged.outliers += RemoveOutliers(options.outlier_sigmas, views);
    Observation mean{key.first, -1, key.second, 0, 0, 0, Eigen::Vector3d::Zero(), 0};
    double weights = 0;
    for (const Observation& o : views) {
      weights += 1 / o.variance;
      mean.relative_luminance += o.relative_luminance / o.variance;
      mean.relative_rgb += o.relative_rgb / o.variance;
      mean.relative_ambient += o.relative_ambient / o.variance;
      mean.pixels += o.pixels;
    }
    if (weights == 0) continue;
    mean.relative_luminance /= weights;
    mean.relative_rgb /= weights;
    mean.relative_ambient /= weights;
    mean.variance = 1 / weights;
    merged.observations.push_back(mean);
  }
  return merged;
}

}  // namespace luxfit
