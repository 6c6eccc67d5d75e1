#include "inverse/albedo/photometric_stereo.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "calib/luminance/median.h"

namespace luxfit {
namespace {

// A direction that is adjusted by so many of its sigmas was measured less well than stated.
constexpr double kSuspectSigmas = 3;

// Returns the factor from the solution's unit to reflectance; NaN where no pixel of the reference is
// determined.
double ReferenceFactor(const PhotometricStereo& result, const StereoRegions& regions) {
  std::vector<double> albedo;
  for (size_t i = 0; i < regions.is_reference.size(); ++i) {
    const double value = result.albedo[static_cast<Eigen::Index>(i)];
    if (regions.is_reference[i] && std::isfinite(value)) albedo.push_back(value);
  }
  return regions.reference_albedo / Quantile(std::move(albedo), 0.5);
}

void SummarizePixels(const PhotometricStereo& result, const StereoRegions& regions, StereoSummary& summary) {
  std::vector<double> albedos, albedo_sigmas, normal_sigmas;
  for (size_t i = 0; i < regions.is_object.size(); ++i) {
    if (!regions.is_object[i]) continue;
    ++summary.pixels;
    const Eigen::Index at = static_cast<Eigen::Index>(i);
    if (!std::isfinite(result.albedo[at])) continue;
    albedos.push_back(summary.factor * result.albedo[at]);
    if (result.albedo_sigma.size() == 0) continue;
    albedo_sigmas.push_back(summary.factor * result.albedo_sigma[at]);
    normal_sigmas.push_back(result.normal_sigma_rad[at]);
  }
  summary.albedo_sigma = Quantile(std::move(albedo_sigmas), 0.5);
  summary.normal_sigma_rad = Quantile(std::move(normal_sigmas), 0.5);
  summary.determined = static_cast<int>(albedos.size());
  if (albedos.empty()) {
    summary.albedo_mean = summary.albedo_variation = NAN;
    return;
  }
  const Eigen::Map<const Eigen::ArrayXd> albedo(albedos.data(), static_cast<Eigen::Index>(albedos.size()));
  const double mean = albedo.mean();
  summary.albedo_mean = mean;
  summary.albedo_variation = std::sqrt((albedo - mean).square().mean()) / mean;
}

// Returns the median absolute residual of one image over the object.
double MedianResidual(const PhotometricStereo& result, const StereoRegions& regions, Eigen::Index image) {
  std::vector<double> sizes;
  for (size_t i = 0; i < regions.is_object.size(); ++i) {
    const double r = result.residual(image, static_cast<Eigen::Index>(i));
    if (regions.is_object[i] && std::isfinite(r)) sizes.push_back(std::abs(r));
  }
  return Quantile(std::move(sizes), 0.5);
}

void SummarizeLights(const StereoData& data, const PhotometricStereo& result, const StereoRegions& regions,
                     StereoSummary& summary) {
  const Eigen::Index images = data.to_light.cols();
  summary.adjusted_rad.resize(images);
  summary.median_residual.resize(images);
  for (Eigen::Index k = 0; k < images; ++k) {
    const Eigen::Vector3d adjusted = result.to_light.col(k);
    summary.adjusted_rad[k] = std::acos(std::min(1.0, adjusted.dot(data.to_light.col(k))));
    summary.median_residual[k] = MedianResidual(result, regions, k);
    const double sigma = data.direction_sigma_rad.size() > 0 ? data.direction_sigma_rad[k] : 0;
    if (sigma > 0 && summary.adjusted_rad[k] >= kSuspectSigmas * sigma)
      summary.suspect_lights.push_back(static_cast<int>(k));
  }
}

}  // namespace

StereoSummary Summarize(const StereoData& data, const PhotometricStereo& result,
                        const StereoRegions& regions) {
  const auto pixels = static_cast<size_t>(data.value.cols());
  if (!result.IsUsable() || regions.is_object.size() != pixels || regions.is_reference.size() != pixels)
    throw std::invalid_argument("Summarize: expected a usable solution and regions of its pixels");
  StereoSummary summary;
  const double factor = ReferenceFactor(result, regions);
  summary.is_absolute = std::isfinite(factor);
  if (summary.is_absolute) summary.factor = factor;
  SummarizePixels(result, regions, summary);
  SummarizeLights(data, result, regions, summary);
  return summary;
}

}  // namespace luxfit
