#include "forward/radiosity/internal/light_exchange.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

constexpr float kPi = 3.14159265f;
// The illuminance anywhere in a field whose one coefficient is the zeroth, 1.
constexpr float kUniform = kPi * 0.282095f;

}  // namespace

LightExchange::LightExchange(const LightTree& tree, const std::vector<float>& albedo_by_facet)
    : tree_(tree), albedo_(albedo_by_facet) {
  const size_t clusters = static_cast<size_t>(tree.cluster_count());
  for (size_t f = 0; f < albedo_by_facet.size(); ++f)
    cosine_.push_back(ClampedCosine(tree[static_cast<int>(clusters + f)].normal));
  field_.assign(clusters, DirectionalLight::Zero());
  intensity_ = field_;
  Grow();
}

void LightExchange::Grow() {
  for (std::vector<float>* values : {&direct_lx_, &received_lx_, &exitance_, &spread_, &free_, &landing_})
    values->resize(static_cast<size_t>(tree_.size()), 0);
}

void LightExchange::Inherit(int parent) {
  const LightNode& node = tree_[parent];
  for (int k = 0; k < node.child_count; ++k) {
    const size_t c = static_cast<size_t>(node.child[static_cast<size_t>(k)]);
    for (std::vector<float>* values : {&direct_lx_, &received_lx_, &exitance_, &free_, &landing_})
      (*values)[c] = (*values)[static_cast<size_t>(parent)];
  }
}

void LightExchange::Start(float ambient_lx) {
  std::fill(received_lx_.begin(), received_lx_.end(), ambient_lx);
  Reflect();
}

double LightExchange::LandingFlux() const {
  double flux_lm = 0;
  for (int i = tree_.cluster_count(); i < tree_.size(); ++i) {
    const size_t n = static_cast<size_t>(i);
    if (tree_[i].IsLeaf()) flux_lm += tree_[i].area_m2 * free_[n] * landing_[n] * exitance_[n];
  }
  return flux_lm;
}

void LightExchange::Balance(double landing_lm) {
  double received_lm = 0;
  for (int i = tree_.cluster_count(); i < tree_.size(); ++i) {
    const size_t n = static_cast<size_t>(i);
    if (tree_[i].IsLeaf()) received_lm += tree_[i].area_m2 * free_[n] * received_lx_[n];
  }
  if (received_lm == 0) return;
  const float scale = static_cast<float>(landing_lm / received_lm);
  for (float& lx : received_lx_) lx *= scale;
}

double LightExchange::Gather(const std::vector<LightLink>& links) {
  const double landing_lm = LandingFlux();
  std::fill(received_lx_.begin(), received_lx_.end(), 0.0f);
  std::fill(field_.begin(), field_.end(), DirectionalLight::Zero());
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, links.size(), 16384), [&](const tbb::blocked_range<size_t>& range) {
        // The range covers whole receivers: from the first that begins in it to the end of the last.
        size_t i = range.begin();
        while (i > 0 && i < links.size() && links[i].receiver == links[i - 1].receiver) ++i;
        while (i < range.end()) {
          const int receiver = links[i].receiver;
          const bool cluster = tree_[receiver].IsCluster();
          float sum_lx = 0;
          DirectionalLight field = DirectionalLight::Zero();
          for (; i < links.size() && links[i].receiver == receiver; ++i) {
            const LightLink& link = links[i];
            const size_t q = static_cast<size_t>(link.source);
            const bool from_cluster = tree_[link.source].IsCluster();
            if (!cluster && !from_cluster) {
              sum_lx += link.factor * exitance_[q];
              continue;
            }
            if (AreNear(tree_[receiver], tree_[link.source])) {
              sum_lx += link.factor * exitance_[q];
              continue;
            }
            const Eigen::Vector3d d = (tree_[link.source].center - tree_[receiver].center).normalized();
            const float light =
                from_cluster ? std::max(0.0f, intensity_[q].dot(Harmonics(-d))) : exitance_[q];
            if (cluster) {
              field += link.factor * light * Harmonics(d);
            } else {
              sum_lx += link.factor * light;
            }
          }
          const float free = free_[static_cast<size_t>(receiver)];
          if (free > 0 && !cluster) received_lx_[static_cast<size_t>(receiver)] = sum_lx / free;
          if (cluster) {
            field[0] += sum_lx / kUniform;
            field_[static_cast<size_t>(receiver)] = field;
          }
        }
      });
  Push();
  Balance(landing_lm);
  return Reflect();
}

void LightExchange::Push() {
  for (int i = 0; i < tree_.size(); ++i) {
    const LightNode& node = tree_[i];
    for (int k = 0; k < node.child_count; ++k) {
      const int child = node.child[static_cast<size_t>(k)];
      const size_t c = static_cast<size_t>(child);
      if (!node.IsCluster()) {
        received_lx_[c] += received_lx_[static_cast<size_t>(i)];
      } else if (tree_[child].IsCluster()) {
        field_[c] += field_[static_cast<size_t>(i)];
      } else {
        const DirectionalLight& cosine = cosine_[static_cast<size_t>(tree_[child].facet)];
        received_lx_[c] += std::max(0.0f, cosine.dot(field_[static_cast<size_t>(i)]));
      }
    }
  }
}

double LightExchange::Reflect() {
  double change = 0, area = 0;
  for (int i = tree_.size() - 1; i >= 0; --i) {
    const LightNode& node = tree_[i];
    if (node.IsCluster()) {
      PullCluster(i);
    } else if (!node.IsLeaf()) {
      PullElement(i);
    } else {
      const size_t leaf = static_cast<size_t>(i);
      const float exitance = albedo_[static_cast<size_t>(node.facet)] * illuminance_lx(i);
      change += node.area_m2 * std::abs(exitance - exitance_[leaf]);
      area += node.area_m2;
      exitance_[leaf] = exitance;
      spread_[leaf] = 0;
    }
  }
  return area > 0 ? change / area : 0;
}

void LightExchange::PullElement(int i) {
  const LightNode& node = tree_[i];
  double area = 0, mean = 0, square = 0;
  for (int k = 0; k < node.child_count; ++k) {
    const size_t c = static_cast<size_t>(node.child[static_cast<size_t>(k)]);
    const double exitance = exitance_[c], spread = spread_[c];
    const double free_area = tree_[static_cast<int>(c)].area_m2 * free_[c];
    area += free_area;
    mean += free_area * exitance;
    square += free_area * (exitance * exitance + spread * spread);
  }
  const size_t n = static_cast<size_t>(i);
  free_[n] = static_cast<float>(area / node.area_m2);
  mean = area > 0 ? mean / area : 0;
  exitance_[n] = static_cast<float>(mean);
  spread_[n] = area > 0 ? static_cast<float>(std::sqrt(std::max(0.0, square / area - mean * mean))) : 0.0f;
}

void LightExchange::PullCluster(int i) {
  const LightNode& node = tree_[i];
  DirectionalLight intensity = DirectionalLight::Zero();
  double flux = 0, area = 0;
  for (int k = 0; k < 2; ++k) {
    const int child = node.child[static_cast<size_t>(k)];
    const LightNode& member = tree_[child];
    const float exitance = exitance_[static_cast<size_t>(child)];
    const double free_area = member.area_m2 * free_[static_cast<size_t>(child)];
    area += free_area;
    flux += free_area * exitance;
    if (member.IsCluster()) {
      intensity += intensity_[static_cast<size_t>(child)];
    } else {
      intensity +=
          static_cast<float>(member.area_m2) * exitance / kPi * cosine_[static_cast<size_t>(member.facet)];
    }
  }
  intensity_[static_cast<size_t>(i)] = intensity;
  free_[static_cast<size_t>(i)] = static_cast<float>(area / node.area_m2);
  exitance_[static_cast<size_t>(i)] = area > 0 ? static_cast<float>(flux / area) : 0.0f;
}

double LightExchange::MeanIlluminance() const {
  double sum = 0, area = 0;
  for (int i = tree_.cluster_count(); i < tree_.size(); ++i) {
    if (!tree_[i].IsLeaf()) continue;
    const double free_area = tree_[i].area_m2 * free_[static_cast<size_t>(i)];
    sum += free_area * illuminance_lx(i);
    area += free_area;
  }
  return area > 0 ? sum / area : 0;
}

}  // namespace luxfit
