#include "inverse/albedo/patch_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/albedo/internal/albedo_ratios.h"
#include "inverse/albedo/internal/reflectance_sigma.h"
#include "inverse/select/internal/robust_weight.h"

namespace luxfit {
namespace {

constexpr double kLargestAlbedoZ2 = 9;  // limit of z^2 for one observation left out
constexpr std::array<AlbedoDetail, 3> kDetails = {AlbedoDetail::kMaterial, AlbedoDetail::kPatch,
                                                  AlbedoDetail::kElement};

using Ratios = std::vector<AlbedoRatio>;
using RatioIndices = std::vector<size_t>;

int UnitOf(const AlbedoRatio& ratio, AlbedoDetail detail) {
  if (detail == AlbedoDetail::kElement) return ratio.element;
  return detail == AlbedoDetail::kPatch ? ratio.patch : 0;
}

// Holds the albedo on which some observations agree.
struct AgreedAlbedo {
  double albedo = NAN;
  double sigma = 0;
  int observations = 0;
};

// Fits one material's observations.
class MaterialFit {
 public:
  MaterialFit(const Ratios& ratios, RatioIndices own, const PatchAlbedoOptions& options)
      : ratios_(ratios), own_(std::move(own)), options_(options) {}

  std::map<int, RatioIndices> Units(AlbedoDetail detail) const {
    std::map<int, RatioIndices> units;
    for (const size_t i : own_) units[UnitOf(ratios_[i], detail)].push_back(i);
    return units;
  }

  // Weights by noise and model error, with Cauchy weights that start at the median.
  AgreedAlbedo RobustMean(const RatioIndices& indices, double model_error) const {
    AgreedAlbedo mean;
    mean.observations = static_cast<int>(indices.size());
    std::vector<double> values;
    values.reserve(indices.size());
    for (const size_t i : indices) values.push_back(ratios_[i].value);
    mean.albedo = Median(std::move(values));
    if (!(mean.albedo > 0)) return mean;
    for (int iteration = 0; iteration < 10; ++iteration) {
      double weights = 0, sum = 0;
      for (const size_t i : indices) {
        const double w = WeightOf(ratios_[i], mean.albedo, model_error);
        weights += w;
        sum += w * ratios_[i].value;
      }
      mean.albedo = sum / weights;
    }
    mean.sigma = SigmaOf(indices, mean.albedo, model_error);
    return mean;
  }

  // Returns relative residuals of every observation, predicted from the others, in the order of `own`.
  std::vector<double> LeftOutResiduals(AlbedoDetail detail, double model_error) const {
    std::vector<double> residuals(own_.size());
    for (int fold = 0; fold < options_.folds; ++fold) {
      std::array<std::map<int, RatioIndices>, 3> kept;
      for (const size_t i : own_) {
        if (FoldOf(ratios_[i]) == fold) continue;
        for (size_t d = 0; d < kDetails.size(); ++d) kept[d][UnitOf(ratios_[i], kDetails[d])].push_back(i);
      }
      std::array<std::map<int, double>, 3> means;
      for (size_t d = 0; d <= static_cast<size_t>(detail); ++d) {
        for (const auto& [unit, indices] : kept[d]) means[d][unit] = RobustMean(indices, model_error).albedo;
      }
      for (size_t place = 0; place < own_.size(); ++place) {
        const AlbedoRatio& ratio = ratios_[own_[place]];
        if (FoldOf(ratio) != fold) continue;
        residuals[place] = NAN;
        for (size_t d = static_cast<size_t>(detail) + 1; d-- > 0;) {
          const auto mean = means[d].find(UnitOf(ratio, kDetails[d]));
          if (mean == means[d].end()) continue;
          residuals[place] = ratio.value / mean->second - 1;
          break;
        }
      }
    }
    return residuals;
  }

  const RatioIndices& own() const { return own_; }

 private:
  // Puts the states of one element into different parts.
  int FoldOf(const AlbedoRatio& ratio) const { return (ratio.element + ratio.state) % options_.folds; }

  static double Sigma(const AlbedoRatio& ratio, double albedo, double model_error) {
    return albedo * std::hypot(ratio.relative_noise, model_error);
  }
  double WeightOf(const AlbedoRatio& ratio, double albedo, double model_error) const {
    const double sigma = Sigma(ratio, albedo, model_error);
    return CauchyWeight((ratio.value - albedo) / sigma, options_.robust_sigmas) / (sigma * sigma);
  }

  // Returns a sigma that is cluster-robust by facet and state, never below that of independent errors.
  double SigmaOf(const RatioIndices& indices, double albedo, double model_error) const {
    double weights = 0;
    std::map<std::pair<int, int>, double> pulls;
    for (const size_t i : indices) {
      const AlbedoRatio& ratio = ratios_[i];
      const double w = WeightOf(ratio, albedo, model_error);
      weights += w;
      pulls[{ratio.facet, ratio.state}] += w * (ratio.value - albedo);
    }
    double scatter = 0;
    for (const auto& [cluster, pull] : pulls) scatter += pull * pull;
    const double clusters = static_cast<double>(pulls.size());
    if (clusters > 1) scatter *= clusters / (clusters - 1);
    return std::max(std::sqrt(1 / weights), std::sqrt(scatter) / weights);
  }

  const Ratios& ratios_;
  RatioIndices own_;
  const PatchAlbedoOptions& options_;
};

// Returns the smallest relative error of one observation that any detail leaves, less the photos' noise.
double ModelError(const Ratios& ratios, const std::vector<MaterialFit>& fits,
                  const PatchAlbedoOptions& options) {
  double smallest = 1;
  for (const AlbedoDetail detail : kDetails) {
    std::vector<double> sizes, noises;
    for (const MaterialFit& fit : fits) {
      const std::vector<double> residuals = fit.LeftOutResiduals(detail, 0.01);
      for (size_t i = 0; i < residuals.size(); ++i) {
        if (!std::isfinite(residuals[i])) continue;
        sizes.push_back(std::abs(residuals[i]));
        noises.push_back(ratios[fit.own()[i]].relative_noise);
      }
    }
    const double size = kSigmaPerMad * Median(std::move(sizes)), noise = Median(std::move(noises));
    if (std::isfinite(size))
      smallest = std::min(smallest, std::sqrt(std::max(0.0, size * size - noise * noise)));
  }
  return std::max(smallest, options.min_model_error);
}

// Returns min(z^2, 9) of every observation left out; NaN where nothing predicts it.
std::vector<double> Losses(const Ratios& ratios, const MaterialFit& fit, AlbedoDetail detail,
                           double model_error) {
  std::vector<double> losses = fit.LeftOutResiduals(detail, model_error);
  for (size_t i = 0; i < losses.size(); ++i) {
    const double sigma = std::hypot(ratios[fit.own()[i]].relative_noise, model_error);
    if (std::isfinite(losses[i])) losses[i] = std::min(std::pow(losses[i] / sigma, 2), kLargestAlbedoZ2);
  }
  return losses;
}

// Sum of a - b over the observations of a facet in one state, whose errors are not independent.
struct StateDifference {
  double sum = 0, count = 0;
};
using FacetDifferences = std::map<int, std::map<int, StateDifference>>;  // by facet and state

// Returns the variance of the sum over all. States of a facet are replicates: that a detail helps on one facet alone,
// in all states alike, is no error. A facet that one state shows is compared with `mean`, that of all.
double ScatterOf(const FacetDifferences& by_facet, double mean) {
  double scatter = 0, clusters = 0;
  for (const auto& [facet, states] : by_facet) clusters += static_cast<double>(states.size());
  for (const auto& [facet, states] : by_facet) {
    const bool is_alone = states.size() == 1;
    const double n = is_alone ? clusters : static_cast<double>(states.size());
    if (n == 1) return INFINITY;  // one cluster cannot tell its own error
    StateDifference all;
    for (const auto& [state, d] : states) all = {all.sum + d.sum, all.count + d.count};
    const double centre = is_alone ? mean : all.sum / all.count;
    for (const auto& [state, d] : states) scatter += n / (n - 1) * std::pow(d.sum - d.count * centre, 2);
  }
  return scatter;
}

struct Compared {
  double mean = 0;   // mean of a - b
  double error = 0;  // standard error of that mean
  double score = 0;  // mean of b
};
Compared Compare(const Ratios& ratios, const RatioIndices& own, const std::vector<double>& a,
                 const std::vector<double>& b) {
  Compared result;
  double count = 0;
  for (size_t i = 0; i < own.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    count += 1;
    result.mean += a[i] - b[i];
    result.score += b[i];
  }
  if (count == 0) return result;
  result.mean /= count;
  result.score /= count;
  FacetDifferences by_facet;
  for (size_t i = 0; i < own.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    StateDifference& state = by_facet[ratios[own[i]].facet][ratios[own[i]].state];
    state.sum += a[i] - b[i];
    state.count += 1;
  }
  result.error = std::sqrt(ScatterOf(by_facet, result.mean)) / count;
  return result;
}

// Returns the relative spread of the units' albedos beyond their own uncertainty.
double TextureOf(const MaterialFit& fit, AlbedoDetail detail, double model_error) {
  std::vector<double> albedos, sigmas;
  for (const auto& [unit, indices] : fit.Units(detail)) {
    const AgreedAlbedo mean = fit.RobustMean(indices, model_error);
    albedos.push_back(mean.albedo);
    sigmas.push_back(mean.sigma);
  }
  const Eigen::Map<const Eigen::ArrayXd> albedo(albedos.data(), static_cast<Eigen::Index>(albedos.size()));
  const Eigen::Map<const Eigen::ArrayXd> sigma(sigmas.data(), albedo.size());
  const double spread = (albedo - albedo.mean()).square().mean() - sigma.square().mean();
  return std::sqrt(std::max(0.0, spread)) / albedo.mean();
}

void ChooseDetail(const Ratios& ratios, const MaterialFit& fit, double model_error,
                  const PatchAlbedoOptions& options, MaterialAlbedo& material) {
  const std::vector<double> coarsest = Losses(ratios, fit, AlbedoDetail::kMaterial, model_error);
  std::vector<double> chosen = coarsest;
  material.because = "no finer albedo predicts better what was left out, by one standard error";
  for (const AlbedoDetail detail : kDetails) {
    const std::vector<double> losses = Losses(ratios, fit, detail, model_error);
    const Compared with_coarsest = Compare(ratios, fit.own(), coarsest, losses);
    const double texture = detail == AlbedoDetail::kMaterial ? 0 : TextureOf(fit, detail, model_error);
    material.scores.push_back({detail, with_coarsest.score, with_coarsest.error, texture});
    const Compared gain = Compare(ratios, fit.own(), chosen, losses);
    if (detail == AlbedoDetail::kMaterial || !(gain.mean > gain.error)) continue;
    char because[160];
    if (texture < options.least_texture) {
      std::snprintf(because, sizeof because,
                    "albedos vary by %.1f %%, which the forward model's own error may be (%.1f %%)",
                    100 * texture, 100 * options.least_texture);
    } else {
      std::snprintf(because, sizeof because,
                    "predicts better what was left out, by %.2f +- %.2f; albedos vary by %.1f %%", gain.mean,
                    gain.error, 100 * texture);
      material.detail = detail;
      chosen = losses;
    }
    material.because = because;
  }
}

AlbedoUnit UnitFrom(const AlbedoRatio& one, const AgreedAlbedo& mean, AlbedoDetail detail,
                    double common_sigma) {
  AlbedoUnit unit;
  unit.material = one.material;
  if (detail != AlbedoDetail::kMaterial) unit.patch = one.patch;
  if (detail == AlbedoDetail::kElement) unit.element = one.element;
  unit.albedo = mean.albedo;
  unit.sigma = std::hypot(mean.sigma, common_sigma * mean.albedo);
  unit.observations = mean.observations;
  return unit;
}

void CountElements(const MaterialFit& fit, double model_error, MaterialAlbedo& material) {
  for (const auto& [element, indices] : fit.Units(AlbedoDetail::kElement)) {
    const AgreedAlbedo mean = fit.RobustMean(indices, model_error);
    const double off = std::abs(mean.albedo - material.albedo);
    ++material.elements;
    if (off > 4 * mean.sigma && off > 0.1 * material.albedo) ++material.unlike_elements;
  }
}

}  // namespace

std::string ToString(AlbedoDetail detail) {
  switch (detail) {
    case AlbedoDetail::kMaterial:
      return "material";
    case AlbedoDetail::kPatch:
      return "patch";
    case AlbedoDetail::kElement:
      return "element";
  }
  return "";
}

PatchAlbedo EstimatePatchAlbedo(const Room& room, const LightData& data, const LightState& light,
                                const PatchAlbedoOptions& options) {
  const size_t materials = room.scene.materials.size();
  if (options.common_sigma.size() != 0 && options.common_sigma.size() != static_cast<Eigen::Index>(materials))
    throw std::invalid_argument("EstimatePatchAlbedo: expected one common sigma a material");
  const Ratios ratios = AlbedoRatios(room, data, light, options.interreflection);
  std::vector<RatioIndices> by_material(materials);
  for (size_t i = 0; i < ratios.size(); ++i)
    by_material[static_cast<size_t>(ratios[i].material)].push_back(i);
  std::vector<MaterialFit> fits;
  fits.reserve(materials);
  for (RatioIndices& own : by_material) fits.emplace_back(ratios, std::move(own), options);
  PatchAlbedo result;
  result.materials.resize(materials);
  result.model_error = ModelError(ratios, fits, options);
  for (size_t m = 0; m < materials; ++m) {
    MaterialAlbedo& material = result.materials[m];
    material.albedo = NAN;
    if (fits[m].own().empty()) continue;
    const double common =
        options.common_sigma.size() == 0 ? 0 : options.common_sigma[static_cast<Eigen::Index>(m)];
    const AgreedAlbedo mean = fits[m].RobustMean(fits[m].own(), result.model_error);
    material.albedo = mean.albedo;
    material.sigma = std::hypot(mean.sigma, common * mean.albedo);
    material.observations = mean.observations;
    CountElements(fits[m], result.model_error, material);
    ChooseDetail(ratios, fits[m], result.model_error, options, material);
    for (const auto& [unit, indices] : fits[m].Units(material.detail)) {
      result.units.push_back(UnitFrom(
          ratios[indices.front()], fits[m].RobustMean(indices, result.model_error), material.detail, common));
    }
  }
  return result;
}

PatchAlbedo EstimatePatchAlbedo(const Room& room, const LightData& data, const LuminaireFit& fit,
                                PatchAlbedoOptions options) {
  if (options.common_sigma.size() == 0) options.common_sigma = SigmaOfReflectances(room, fit);
  return EstimatePatchAlbedo(room, data, fit.state, options);
}

}  // namespace luxfit
