#include "inverse/observe/camera/veiling_glare.h"

#include <algorithm>
#include <cmath>

#include "calib/luminance/median.h"
#include "inverse/observe/camera/internal/view_slope.h"

namespace luxfit {
namespace {

constexpr int kVeilRounds = 3;
constexpr double kVeilTolerance = 1e-5;  // of g
constexpr double kLeastLeft = 0.5;       // share of an observation that is no veil
constexpr double kLargestVeil = 0.3;     // beyond it, the first order in g tells nothing

double MeanOf(const ImagePlane& plane) {
  const auto is_finite = plane.isFinite();
  const auto count = is_finite.count();
  return count > 0 ? is_finite.select(plane, 0.0f).cast<double>().sum() / static_cast<double>(count) : 0;
}

const PictureMean& MeanOf(const PictureMeans& means, const Observation& o) {
  return means.at({o.view, o.state});
}

// Returns whether enough is left of an observation of which a share of its picture's mean was taken out.
bool TakeOut(double share, double sigma, const PictureMean& mean, Observation& o) {
  const double before = o.relative_luminance;
  o.relative_luminance -= share * mean.relative_luminance;
  o.relative_rgb -= share * mean.relative_rgb;
  o.variance += std::pow(sigma * mean.relative_luminance, 2);
  return o.relative_luminance > kLeastLeft * before;
}

std::vector<Observation> Without(const std::vector<Observation>& observations, const PictureMeans& means,
                                 double share) {
  std::vector<Observation> left;
  left.reserve(observations.size());
  for (Observation o : observations)
    if (TakeOut(share, 0, MeanOf(means, o), o)) left.push_back(o);
  return left;
}

// Returns what a veil of all of the mean would add to ln of the ratios of a pair.
std::vector<double> PerShare(const PhotoPair& pair, const std::vector<Observation>& observations,
                             const PictureMeans& means, double log_ratio) {
  const double of_a = means.at({pair.a, pair.state}).relative_luminance * std::exp(-log_ratio / 2);
  const double of_b = means.at({pair.b, pair.state}).relative_luminance * std::exp(log_ratio / 2);
  std::vector<double> per_share;
  per_share.reserve(pair.shared.size());
  for (const auto& [a, b] : pair.shared)
    per_share.push_back((of_a - of_b) /
                        std::sqrt(observations[a].relative_luminance * observations[b].relative_luminance));
  return per_share;
}

std::optional<ViewSlope> ShareLeft(const std::vector<Observation>& observations, const PictureMeans& means,
                                   const std::vector<int>& camera_of_view, int camera) {
  const std::vector<PhotoPair> pairs = PairViews(observations, camera_of_view, camera);
  std::vector<std::vector<double>> log_ratios, per_share;
  log_ratios.reserve(pairs.size());
  per_share.reserve(pairs.size());
  for (const PhotoPair& pair : pairs) {
    log_ratios.push_back(LogRatios(pair, observations));
    per_share.push_back(PerShare(pair, observations, means, Median(log_ratios.back())));
  }
  return SlopeOverViews(pairs, std::move(log_ratios), std::move(per_share), kVeilTolerance);
}

std::optional<VeilingGlare> VeilOf(const std::vector<Observation>& observations, const PictureMeans& means,
                                   const std::vector<int>& camera_of_view, int camera) {
  VeilingGlare veil;
  std::vector<Observation> left = observations;
  for (int round = 0; round < kVeilRounds; ++round) {
    const auto found = ShareLeft(left, means, camera_of_view, camera);
    if (!found) return std::nullopt;
    if (round == 0) veil.difference = found->spread;
    veil.share += found->slope;
    veil.sigma = found->sigma;
    veil.views = found->views;
    veil.difference_without = found->spread_without;
    if (!(std::abs(veil.share) < kLargestVeil)) return std::nullopt;
    left = Without(observations, means, veil.share);
  }
  return veil;
}

}  // namespace

PictureMean PictureMeanOf(const LuminanceImage& image) {
  PictureMean mean{MeanOf(image.relative_luminance)};
  for (size_t c = 0; c < 3; ++c)
    mean.relative_rgb[static_cast<Eigen::Index>(c)] = MeanOf(image.relative_rgb[c]);
  return mean;
}

std::vector<std::optional<VeilingGlare>> FindVeilingGlare(const std::vector<Observation>& observations,
                                                          const PictureMeans& means,
                                                          const std::vector<int>& camera_of_view,
                                                          int cameras) {
  std::vector<std::vector<Observation>> of_camera(static_cast<size_t>(cameras));
  for (const Observation& o : observations)
    of_camera.at(static_cast<size_t>(camera_of_view.at(static_cast<size_t>(o.view)))).push_back(o);
  std::vector<std::optional<VeilingGlare>> found;
  found.reserve(of_camera.size());
  for (int camera = 0; camera < cameras; ++camera)
    found.push_back(VeilOf(of_camera[static_cast<size_t>(camera)], means, camera_of_view, camera));
  return found;
}

std::vector<Observation> WithoutVeils(std::vector<Observation> observations, const PictureMeans& means,
                                      const std::vector<int>& camera_of_view,
                                      const std::vector<std::optional<VeilingGlare>>& by_camera) {
  const auto is_lost = [&](Observation& o) {
    const auto& veil = by_camera.at(static_cast<size_t>(camera_of_view.at(static_cast<size_t>(o.view))));
    return veil && veil->IsFound() && !TakeOut(veil->share, veil->sigma, MeanOf(means, o), o);
  };
  std::vector<Observation> left;
  left.reserve(observations.size());
  for (Observation& o : observations)
    if (!is_lost(o)) left.push_back(o);
  return left;
}

}  // namespace luxfit
