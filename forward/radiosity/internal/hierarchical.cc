#include "forward/radiosity/internal/hierarchical.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "forward/radiosity/internal/leaf_light.h"
#include "forward/radiosity/internal/light_exchange.h"
#include "forward/radiosity/internal/light_links.h"
#include "forward/radiosity/internal/light_tree.h"

namespace luxfit {
namespace {

using Verdict = LinkEvaluation::Verdict;

struct Candidate {
  int32_t receiver, source;
};

// Holds the illuminance that a link or a leaf leaves uncertain, and the node to cut to reduce it.
struct Uncertainty {
  double lx = 0;
  double urgency_lx = 0;  // decides whether to cut
  int cut = -1;           // node; -1: none may be cut further
};

// Parts of an uneven source mostly exist already, and to take it as even errs the same way for many
// receivers. To cut it costs less and gains more than to cut receivers.
constexpr double kSourceUrgency = 4;

class Refinement {
 public:
  Refinement(const Scene& scene, const RayScene& rays, const Eigen::VectorXd& albedo,
             const DirectLight& direct_lx, const HierarchicalOptions& options)
      : scene_(scene),
        rays_(rays),
        direct_at_(direct_lx),
        options_(options),
        tree_(scene),
        albedo_(AlbedoByFacet(scene, albedo)),
        exchange_(tree_, albedo_) {
    for (const Facet& facet : scene.facets) {
      area_m2_ += facet.AreaM2();
      mean_albedo_ += facet.AreaM2() * albedo[facet.material];
    }
    mean_albedo_ /= area_m2_;
    for (int i = tree_.cluster_count(); i < tree_.size(); ++i) fresh_.push_back(i);
  }

  HierarchicalSolution Run();

 private:
  static std::vector<float> AlbedoByFacet(const Scene& scene, const Eigen::VectorXd& albedo) {
    std::vector<float> by_facet;
    for (const Facet& facet : scene.facets) by_facet.push_back(static_cast<float>(albedo[facet.material]));
    return by_facet;
  }
  // Returns the weight of a receiver's error in the rms over all area.
  double Weight(int node) const { return std::sqrt(tree_[node].area_m2 / area_m2_); }
  bool IsTolerable(double lx, int receiver) const { return lx * Weight(receiver) <= threshold_ * mean_lx_; }
  bool CanCut(int node) const {
    return !tree_[node].IsLeaf() || tree_[node].LongestEdge() >= 2 * options_.min_element_m;
  }
  Uncertainty UncertaintyOf(const LightLink& link) const;
  double ToleranceOf(const Candidate& candidate) const;

  void CutLeaf(int node);
  void RefineDirect();
  void EvaluateFresh();
  void RefineLinks();
  std::vector<Candidate> TakeIntolerable();
  void Expand(const Candidate& candidate, int cut, std::vector<Candidate>& next);
  void GatherToConvergence();
  double EstimateError() const;
  HierarchicalSolution Result() const;

  const Scene& scene_;
  const RayScene& rays_;
  const DirectLight& direct_at_;
  const HierarchicalOptions& options_;
  LightTree tree_;
  std::vector<float> albedo_;
  LightExchange exchange_;
  std::vector<LightLink> links_;
  std::vector<float> direct_error_;  // by node: rms deviation from its mean, lx
  std::vector<int> fresh_;           // leaves without direct light
  double area_m2_ = 0, mean_albedo_ = 0, mean_lx_ = 0;
  double threshold_ = 0;  // as a share of mean_lx_
  int iterations_ = 0, rounds_ = 0;
  int64_t cuts_ = 0;  // in this round
  bool out_of_links_ = false;
};

Uncertainty Refinement::UncertaintyOf(const LightLink& link) const {
  const LightNode &p = tree_[link.receiver], &q = tree_[link.source];
  const double from_receiver = std::abs(link.error) * exchange_.exitance(link.source);
  if (p.IsCluster() || q.IsCluster()) {
    const bool source_first = link.error < 0;
    const int first = source_first ? link.source : link.receiver,
              second = source_first ? link.receiver : link.source;
    return {from_receiver, from_receiver, CanCut(first) ? first : (CanCut(second) ? second : -1)};
  }
  // Parts of a source that is not evenly bright are seen under angles that differ by its size over the
  // distance.
  const double nearness = std::min(1.0, q.radius_m / std::max((q.center - p.center).norm(), 1e-9));
  const double from_source = exchange_.spread(link.source) * std::hypot(link.factor * nearness, link.shadow);
  Uncertainty uncertainty{std::hypot(from_receiver, from_source),
                          std::hypot(from_receiver, kSourceUrgency * from_source), -1};
  const bool uneven = kSourceUrgency * from_source > from_receiver;
  if (uneven || link.error < 0) {
    if (CanCut(link.source)) uncertainty.cut = link.source;
  }
  if (uncertainty.cut < 0 && !uneven && CanCut(link.receiver)) uncertainty.cut = link.receiver;
  return uncertainty;
}

double Refinement::ToleranceOf(const Candidate& candidate) const {
  const double exitance = std::max<double>(exchange_.exitance(candidate.source), 1e-9 * mean_lx_);
  return threshold_ * mean_lx_ / Weight(candidate.receiver) / exitance;
}

void Refinement::CutLeaf(int node) {
  tree_.Split(node);
  exchange_.Grow();
  exchange_.Inherit(node);
  for (int k = 0; k < tree_[node].child_count; ++k)
    fresh_.push_back(tree_[node].child[static_cast<size_t>(k)]);
  ++cuts_;
}

void Refinement::EvaluateFresh() {
  direct_error_.resize(static_cast<size_t>(tree_.size()), 0);
  std::vector<LeafLight> light(fresh_.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, fresh_.size(), 64),
                    [&](const tbb::blocked_range<size_t>& range) {
                      for (size_t i = range.begin(); i < range.end(); ++i)
                        light[i] = EvaluateLeaf(tree_, scene_, rays_, direct_at_, fresh_[i]);
                    });
  for (size_t i = 0; i < fresh_.size(); ++i) {
    exchange_.SetDirect(fresh_[i], light[i].direct_lx, light[i].free, light[i].landing);
    direct_error_[static_cast<size_t>(fresh_[i])] = light[i].direct_error_lx;
  }
  fresh_.clear();
}

void Refinement::RefineDirect() {
  EvaluateFresh();
  for (int i = tree_.cluster_count(); i < tree_.size(); ++i) {
    if (i > 0 && !fresh_.empty() && i == fresh_.front())
      EvaluateFresh();  // all leaves before it have been judged
    if (!tree_[i].IsLeaf()) continue;
    const bool coarse = tree_[i].LongestEdge() > options_.max_element_m;
    if (coarse || (!IsTolerable(direct_error_[static_cast<size_t>(i)], i) && CanCut(i))) CutLeaf(i);
  }
  EvaluateFresh();
}

std::vector<Candidate> Refinement::TakeIntolerable() {
  std::vector<Candidate> next;
  size_t kept = 0;
  for (const LightLink& link : links_) {
    const Uncertainty uncertainty = UncertaintyOf(link);
    const bool tolerable = IsTolerable(uncertainty.urgency_lx, link.receiver);
    if (tolerable && !IsTolerable(link.doubt * exchange_.exitance(link.source), link.receiver)) {
      next.push_back({link.receiver, link.source});
    } else if (tolerable || uncertainty.cut < 0) {
      links_[kept++] = link;
    } else {
      Expand({link.receiver, link.source}, uncertainty.cut, next);
    }
  }
  links_.resize(kept);
  return next;
}

void Refinement::Expand(const Candidate& candidate, int cut, std::vector<Candidate>& next) {
  if (tree_[cut].IsLeaf()) CutLeaf(cut);
  const LightNode& node = tree_[cut];
  for (int k = 0; k < node.child_count; ++k) {
    const int child = node.child[static_cast<size_t>(k)];
    if (candidate.receiver != candidate.source) {
      next.push_back(cut == candidate.receiver ? Candidate{child, candidate.source}
                                               : Candidate{candidate.receiver, child});
      continue;
    }
    for (int j = 0; j < node.child_count; ++j) next.push_back({child, node.child[static_cast<size_t>(j)]});
  }
}

void Refinement::RefineLinks() {
  std::vector<Candidate> active;
  if (links_.empty()) {
    active.push_back({0, 0});
  } else {
    active = TakeIntolerable();
  }
  while (!active.empty()) {
    std::vector<LinkEvaluation> evaluated(active.size());
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, active.size(), 256), [&](const tbb::blocked_range<size_t>& range) {
          for (size_t i = range.begin(); i < range.end(); ++i) {
            const Candidate& candidate = active[i];
            evaluated[i] =
                EvaluateLink(tree_, rays_, candidate.receiver, candidate.source, ToleranceOf(candidate));
          }
        });
    out_of_links_ = static_cast<int64_t>(links_.size() + active.size()) > options_.max_links;
    std::vector<Candidate> next;
    for (size_t i = 0; i < active.size(); ++i) {
      const Candidate& candidate = active[i];
      const LinkEvaluation& evaluation = evaluated[i];
      if (evaluation.verdict == Verdict::kNone) continue;
      if (evaluation.verdict == Verdict::kTooNear) {
        const LightNode &p = tree_[candidate.receiver], &q = tree_[candidate.source];
        const bool receiver_first = p.radius_m >= q.radius_m;
        const int first = receiver_first ? candidate.receiver : candidate.source;
        const int second = receiver_first ? candidate.source : candidate.receiver;
        // One of the two is a cluster, which can always be cut.
        Expand(candidate, tree_[first].IsCluster() || CanCut(first) ? first : second, next);
        continue;
      }
      const Uncertainty uncertainty = UncertaintyOf(evaluation.link);
      if (uncertainty.cut < 0 || out_of_links_ || IsTolerable(uncertainty.urgency_lx, candidate.receiver)) {
        links_.push_back(evaluation.link);
      } else {
        Expand(candidate, uncertainty.cut, next);
      }
    }
    active.swap(next);
  }
  tbb::parallel_sort(links_.begin(), links_.end(), [](const LightLink& a, const LightLink& b) {
    return a.receiver < b.receiver || (a.receiver == b.receiver && a.source < b.source);
  });
}

void Refinement::GatherToConvergence() {
  // The light still to come is at most the last change over 1 - rho. A 500th of the error is nothing beside
  // it.
  const double enough = 0.002 * 0.01 * options_.error_percent * (1 - mean_albedo_);
  constexpr int kMaxIterations = 500;
  for (int i = 0; i < kMaxIterations; ++i) {
    ++iterations_;
    const double change = exchange_.Gather(links_);
    mean_lx_ = exchange_.MeanIlluminance();
    if (change <= enough * mean_lx_) return;
  }
}

double Refinement::EstimateError() const {
  // Light of neighbouring elements falls off the same way over a receiver: their errors add. The unknown of a
  // cluster (who stands where and hides whom) differs from link to link: its squares add.
  std::vector<double> bound_lx(static_cast<size_t>(tree_.size()), 0), variance = bound_lx;
  for (const LightLink& link : links_) {
    const size_t receiver = static_cast<size_t>(link.receiver);
    const double lx = UncertaintyOf(link).lx;
    if (tree_[link.receiver].IsCluster() || tree_[link.source].IsCluster()) {
      variance[receiver] += lx * lx;
    } else {
      bound_lx[receiver] += lx;
    }
  }
  double square = 0;
  for (int i = 0; i < tree_.size(); ++i) {
    const LightNode& node = tree_[i];
    const size_t n = static_cast<size_t>(i);
    for (int k = 0; k < node.child_count; ++k) {
      bound_lx[static_cast<size_t>(node.child[static_cast<size_t>(k)])] += bound_lx[n];
      variance[static_cast<size_t>(node.child[static_cast<size_t>(k)])] += variance[n];
    }
    if (node.IsLeaf())
      square += node.area_m2 * (bound_lx[n] * bound_lx[n] + variance[n] + std::pow(direct_error_[n], 2));
  }
  return std::sqrt(square / area_m2_) / mean_lx_;
}

HierarchicalSolution Refinement::Result() const {
  HierarchicalSolution solution;
  for (int i = tree_.cluster_count(); i < tree_.size(); ++i) {
    const LightNode& node = tree_[i];
    if (!node.IsLeaf()) continue;
    solution.elements.push_back({node.facet, node.origin, node.edge_u, node.edge_v, node.center, node.area_m2,
                                 exchange_.direct_lx(i), exchange_.illuminance_lx(i)});
  }
  solution.mean_illuminance_lx = mean_lx_;
  solution.link_count = static_cast<int64_t>(links_.size());
  solution.cluster_link_count = std::count_if(links_.begin(), links_.end(), [&](const LightLink& link) {
    return tree_[link.receiver].IsCluster() || tree_[link.source].IsCluster();
  });
  solution.memory_bytes =
      static_cast<int64_t>(links_.capacity() * sizeof(LightLink) +
                           static_cast<size_t>(tree_.size()) * (sizeof(LightNode) + 6 * sizeof(float)));
  solution.refinements = rounds_;
  solution.iterations = iterations_;
  return solution;
}

HierarchicalSolution Refinement::Run() {
  const double wanted = 0.01 * options_.error_percent;
  // The first threshold only bounds direct light from below until the mean is known.
  threshold_ = 1e30;
  mean_lx_ = 1;
  RefineDirect();
  exchange_.Start(0);
  const double direct_mean_lx = exchange_.MeanIlluminance();
  if (direct_mean_lx == 0) {
    HierarchicalSolution solution = Result();
    solution.mean_illuminance_lx = 0;
    solution.converged = true;
    solution.message = "converged: no direct light anywhere";
    return solution;
  }
  mean_lx_ = direct_mean_lx / (1 - mean_albedo_);
  exchange_.Start(static_cast<float>(mean_lx_ - direct_mean_lx));
  threshold_ = 0.2 * wanted;
  double error = 0;
  constexpr int kMaxRounds = 30;
  for (rounds_ = 1; rounds_ <= kMaxRounds; ++rounds_) {
    cuts_ = 0;
    const size_t links_before = links_.size();
    RefineDirect();
    RefineLinks();
    RefineDirect();
    GatherToConvergence();
    error = EstimateError();
    if (error <= wanted || out_of_links_) break;
    // Nothing is left to cut, and a lower threshold would find nothing more.
    if (cuts_ == 0 && links_.size() == links_before && threshold_ < 1e-3 * wanted) break;
    threshold_ *= std::clamp(wanted / error, 0.3, 0.8);
  }
  HierarchicalSolution solution = Result();
  solution.error_percent = 100 * error;
  solution.converged = error <= wanted;
  const std::string estimate =
      "estimated rms error " + std::to_string(solution.error_percent) + " % of the mean";
  if (solution.converged) {
    solution.message = "converged, " + estimate;
  } else {
    solution.message = "not converged, " + estimate +
                       (out_of_links_ ? "; max_links reached: raise it or error_percent"
                                      : "; min_element_m reached: lower it or raise error_percent");
  }
  return solution;
}

}  // namespace

HierarchicalSolution SolveHierarchical(const Scene& scene, const RayScene& rays,
                                       const Eigen::VectorXd& albedo, const DirectLight& direct_lx,
                                       const HierarchicalOptions& options) {
  if (!(albedo.array() >= 0).all() || !(albedo.array() < 1).all() ||
      albedo.size() < static_cast<Eigen::Index>(scene.materials.size()))
    throw std::invalid_argument("SolveHierarchical: expected a reflectance in [0, 1) for every material");
  if (!(options.error_percent > 0) || !(options.min_element_m > 0) ||
      !(options.max_element_m >= options.min_element_m) || options.max_links < 1)
    throw std::invalid_argument(
        "SolveHierarchical: expected error_percent > 0, max_element_m >= min_element_m > 0, max_links >= 1");
  if (scene.facets.empty()) {
    HierarchicalSolution nothing;
    nothing.converged = true;
    nothing.message = "converged: the scene is empty";
    return nothing;
  }
  return Refinement(scene, rays, albedo, direct_lx, options).Run();
}

}  // namespace luxfit
