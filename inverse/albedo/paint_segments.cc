#include "inverse/albedo/paint_segments.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "calib/luminance/median.h"
#include "inverse/albedo/internal/adjoining_elements.h"
#include "inverse/albedo/internal/albedo_ratios.h"
#include "inverse/albedo/internal/even_patches.h"
#include "inverse/albedo/internal/like_regions.h"
#include "inverse/albedo/internal/reflectance_sigma.h"
#include "inverse/select/internal/robust_weight.h"

namespace luxfit {
namespace {

using AdjoiningPairs = std::vector<std::pair<int, int>>;

// Returns the scatter of x_e: that of differences between elements that adjoin, robust.
double ElementSigma(const std::vector<ElementReflectance>& reflectances, const AdjoiningPairs& pairs) {
  constexpr double kLeast = 1e-3;  // photos are no more exact
  std::vector<double> sizes;
  sizes.reserve(pairs.size());
  for (const auto& [a, b] : pairs)
    sizes.push_back(std::abs(
        std::log(reflectances[static_cast<size_t>(a)].albedo / reflectances[static_cast<size_t>(b)].albedo)));
  return sizes.empty() ? kLeast : std::max(kLeast, kSigmaPerMad * Median(std::move(sizes)) / std::sqrt(2));
}

// Returns the mean with Cauchy weights that start at the median; NaN of none.
double RobustMeanOf(const std::vector<double>& values, double sigma) {
  constexpr double kRobustSigmas = 3;
  double mean = Median(values);
  for (int iteration = 0; iteration < 10; ++iteration) {
    double weights = 0, sum = 0;
    for (const double x : values) {
      const double w = CauchyWeight((x - mean) / sigma, kRobustSigmas);
      weights += w;
      sum += w * x;
    }
    mean = sum / weights;
  }
  return mean;
}

// Returns the standard error of a segment's mean. Elements of a patch share their errors.
double StandardErrorOf(const std::map<int, std::vector<double>>& of_patch, double mean, double sigma) {
  if (of_patch.size() < 2) return sigma;
  double scatter = 0;
  for (const auto& [patch, values] : of_patch) scatter += std::pow(RobustMeanOf(values, sigma) - mean, 2);
  const auto count = static_cast<double>(of_patch.size());
  return std::sqrt(scatter / (count * (count - 1)));
}

class PaintSegmenter {
 public:
  PaintSegmenter(const Patches& patches, const std::vector<ElementReflectance>& reflectances,
                 const Eigen::VectorXd& relative_sigma)
      : patches_(patches), reflectances_(reflectances), relative_sigma_(relative_sigma) {
    for (const ElementReflectance& r : reflectances) {
      if (!(r.albedo > 0)) throw std::invalid_argument("SegmentPaints: expected positive reflectances");
      elements_.push_back(r.element);
    }
    pairs_ = AdjoiningElements(patches, elements_);
    result_.element_sigma = ElementSigma(reflectances, pairs_);
  }

  PaintSegments Cut(double shared_sigma) {
    result_.shared_sigma = std::max(shared_sigma, kLeastSharedSigma);
    LikeRegionsOptions options;
    options.shared_sigma = result_.shared_sigma;
    std::vector<ValueInPatch> values;
    values.reserve(elements_.size());
    for (size_t i = 0; i < elements_.size(); ++i)
      values.push_back({std::log(reflectances_[i].albedo), ElementAt(i).area_m2, ElementAt(i).patch});
    const RegionGraph graph = GraphOfEvenPatches(values, pairs_, result_.element_sigma, result_.shared_sigma);
    const LikeRegions regions = GrowLikeRegions(graph.nodes, graph.edges, options);
    result_.least_z = regions.least_z;
    std::vector<std::vector<size_t>> members(static_cast<size_t>(regions.count));
    std::vector<bool> has_say(elements_.size());
    for (size_t i = 0; i < elements_.size(); ++i) {
      const auto node = static_cast<size_t>(graph.of_value[i]);
      members[static_cast<size_t>(regions.of_node[node])].push_back(i);
      has_say[i] = regions.has_say[node];
    }
    for (const std::vector<size_t>& own : members) {
      PaintSegment segment = SegmentOf(own, has_say);
      if (segment.area_m2 >= options.least_m2) result_.segments.push_back(std::move(segment));
    }
    std::stable_sort(result_.segments.begin(), result_.segments.end(),
                     [](const PaintSegment& a, const PaintSegment& b) { return a.area_m2 > b.area_m2; });
    return std::move(result_);
  }

 private:
  const Element& ElementAt(size_t i) const { return patches_.elements[static_cast<size_t>(elements_[i])]; }

  PaintSegment SegmentOf(const std::vector<size_t>& members, const std::vector<bool>& has_say) const {
    PaintSegment segment;
    segment.low_m = std::numeric_limits<double>::infinity();
    segment.high_m = -segment.low_m;
    for (const size_t i : members) {
      const Element& element = ElementAt(i);
      segment.elements.push_back(elements_[i]);
      segment.area_m2 += element.area_m2;
      segment.center += element.area_m2 * element.center;
      segment.normal += element.area_m2 * element.normal;
      segment.low_m = std::min(segment.low_m, element.center.z());
      segment.high_m = std::max(segment.high_m, element.center.z());
    }
    segment.center /= segment.area_m2;
    segment.normal /= segment.area_m2;
    AddReflectance(members, has_say, segment);
    return segment;
  }

  void AddReflectance(const std::vector<size_t>& members, const std::vector<bool>& has_say,
                      PaintSegment& segment) const {
    std::vector<double> logs;
    std::map<int, std::vector<double>> of_patch;
    std::vector<std::vector<double>> tints(3);
    double common = 0, area_m2 = 0;
    for (const size_t i : members) {
      if (!has_say[i]) continue;
      const ElementReflectance& r = reflectances_[i];
      logs.push_back(std::log(r.albedo));
      of_patch[ElementAt(i).patch].push_back(logs.back());
      for (Eigen::Index c = 0; c < 3; ++c) {
        if (r.albedo_rgb[c] > 0)
          tints[static_cast<size_t>(c)].push_back(std::log(r.albedo_rgb[c] / r.albedo));
      }
      common += ElementAt(i).area_m2 * relative_sigma_[patches_.PatchOf(r.element).material];
      area_m2 += ElementAt(i).area_m2;
    }
    const double sigma = std::hypot(result_.element_sigma, result_.shared_sigma);
    const double mean = RobustMeanOf(logs, sigma);
    segment.albedo = std::exp(mean);
    segment.sigma = segment.albedo * std::hypot(StandardErrorOf(of_patch, mean, sigma), common / area_m2);
    for (Eigen::Index c = 0; c < 3; ++c) {
      const std::vector<double>& own = tints[static_cast<size_t>(c)];
      segment.albedo_rgb[c] = own.empty() ? NAN : std::min(1.0, std::exp(mean + RobustMeanOf(own, sigma)));
    }
  }

  const Patches& patches_;
  const std::vector<ElementReflectance>& reflectances_;
  const Eigen::VectorXd& relative_sigma_;
  std::vector<int> elements_;
  AdjoiningPairs pairs_;
  PaintSegments result_;
};

// Returns the median over states of each element's ratios.
std::vector<ElementReflectance> ReflectancesOf(const std::vector<AlbedoRatio>& ratios) {
  std::map<int, std::vector<const AlbedoRatio*>> of_element;
  for (const AlbedoRatio& ratio : ratios) of_element[ratio.element].push_back(&ratio);
  std::vector<ElementReflectance> reflectances;
  reflectances.reserve(of_element.size());
  for (const auto& [element, own] : of_element) {
    const auto median_of = [&, &ratios_of = own](const auto& value_of) {
      std::vector<double> values;
      for (const AlbedoRatio* ratio : ratios_of) {
        if (std::isfinite(value_of(*ratio))) values.push_back(value_of(*ratio));
      }
      return values.empty() ? NAN : Median(std::move(values));
    };
    ElementReflectance reflectance{element, median_of([](const AlbedoRatio& r) { return r.value; })};
    for (Eigen::Index c = 0; c < 3; ++c)
      reflectance.albedo_rgb[c] = median_of([c](const AlbedoRatio& r) { return r.rgb[c]; });
    reflectances.push_back(reflectance);
  }
  return reflectances;
}

}  // namespace

PaintSegments SegmentPaints(const Patches& patches, const std::vector<ElementReflectance>& reflectances,
                            double shared_sigma, const Eigen::VectorXd& relative_sigma) {
  return PaintSegmenter(patches, reflectances, relative_sigma).Cut(shared_sigma);
}

PaintSegments SegmentPaints(const Room& room, const LightData& data, const LuminaireFit& fit) {
  return SegmentPaints(room.patches, ReflectancesOf(ColourRatios(room, data, fit.state)),
                       fit.shared_relative_sigma, SigmaOfReflectances(room, fit));
}

}  // namespace luxfit
