#include "forward/radiosity/internal/light_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace luxfit {
namespace {

LightNode MakeElement(int facet, FacetKind kind, const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
                      const Eigen::Vector3d& edge_v) {
  const bool triangle = kind == FacetKind::kTriangle;
  LightNode node;
  node.facet = facet;
  node.kind = kind;
  node.origin = origin;
  node.edge_u = edge_u;
  node.edge_v = edge_v;
  node.center = origin + (triangle ? 1.0 / 3 : 0.5) * (edge_u + edge_v);
  const Eigen::Vector3d cross = edge_u.cross(edge_v);
  node.normal = cross.normalized();
  node.area_m2 = (triangle ? 0.5 : 1.0) * cross.norm();
  for (const Eigen::Vector3d& corner :
       {origin, Eigen::Vector3d(origin + edge_u), Eigen::Vector3d(origin + edge_v)})
    node.radius_m = std::max(node.radius_m, (corner - node.center).norm());
  return node;
}

}  // namespace

double LightNode::LongestEdge() const {
  const double edge = std::max(edge_u.norm(), edge_v.norm());
  return kind == FacetKind::kTriangle ? std::max(edge, (edge_u - edge_v).norm()) : edge;
}

LightTree::LightTree(const Scene& scene) {
  std::vector<int> facets(scene.facets.size());
  std::iota(facets.begin(), facets.end(), 0);
  // Facets get their numbers once it is known how many clusters precede them: a binary tree has one fewer.
  cluster_count_ = std::max(0, static_cast<int>(facets.size()) - 1);
  if (cluster_count_ > 0) AddCluster(scene, facets, 0, cluster_count_ + 1);
  member_of_.resize(facets.size());
  for (size_t i = 0; i < facets.size(); ++i) member_of_[static_cast<size_t>(facets[i])] = static_cast<int>(i);
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const Facet& facet = scene.facets[f];
    nodes_.push_back(MakeElement(static_cast<int>(f), facet.kind, facet.origin, facet.edge_u, facet.edge_v));
  }
  for (int i = cluster_count_ - 1; i >= 0; --i) {
    LightNode& cluster = nodes_[static_cast<size_t>(i)];
    for (int k = 0; k < 2; ++k) cluster.area_m2 += nodes_[static_cast<size_t>(cluster.child[k])].area_m2;
  }
}

int LightTree::AddCluster(const Scene& scene, std::vector<int>& facets, int first_member, int end_member) {
  const auto begin = facets.begin() + first_member, end = facets.begin() + end_member;
  if (end - begin == 1) return cluster_count_ + *begin;
  Eigen::AlignedBox3d bounds, centers;
  const auto center_of = [&](int f) -> Eigen::Vector3d {
    const Facet& facet = scene.facets[static_cast<size_t>(f)];
    return facet.PointAt(1.0 / 3, 1.0 / 3);
  };
  for (auto it = begin; it != end; ++it) {
    const Facet& facet = scene.facets[static_cast<size_t>(*it)];
    centers.extend(center_of(*it));
    for (const double u : {0.0, 1.0}) {
      for (const double v : {0.0, 1.0}) {
        if (u + v < 2 || facet.kind == FacetKind::kParallelogram) bounds.extend(facet.PointAt(u, v));
      }
    }
  }
  const int index = static_cast<int>(nodes_.size());
  LightNode cluster;
  cluster.center = bounds.center();
  cluster.radius_m = 0.5 * bounds.diagonal().norm();
  cluster.child_count = 2;
  cluster.first_member = first_member;
  cluster.end_member = end_member;
  nodes_.push_back(cluster);
  Eigen::Index axis = 0;
  centers.sizes().maxCoeff(&axis);
  const int middle = first_member + (end_member - first_member) / 2;
  std::nth_element(begin, facets.begin() + middle, end, [&](int a, int b) {
    const double xa = center_of(a)[axis], xb = center_of(b)[axis];
    return xa < xb || (xa == xb && a < b);
  });
  const int first = AddCluster(scene, facets, first_member, middle);
  const int second = AddCluster(scene, facets, middle, end_member);
  nodes_[static_cast<size_t>(index)].child[0] = first;
  nodes_[static_cast<size_t>(index)].child[1] = second;
  return index;
}

void LightTree::Split(int index) {
  const LightNode node = nodes_[static_cast<size_t>(index)];
  const auto add = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
                       const Eigen::Vector3d& edge_v) {
    LightNode& parent = nodes_[static_cast<size_t>(index)];
    parent.child[static_cast<size_t>(parent.child_count++)] = size();
    nodes_.push_back(MakeElement(node.facet, node.kind, origin, edge_u, edge_v));
  };
  const Eigen::Vector3d u = 0.5 * node.edge_u, v = 0.5 * node.edge_v, &o = node.origin;
  if (node.kind == FacetKind::kTriangle) {
    add(o, u, v);
    add(o + u, u, v);
    add(o + v, u, v);
    add(o + u + v, -u, -v);
    return;
  }
  const double ratio = node.edge_u.norm() / node.edge_v.norm();
  const bool cut_u = ratio > 0.5, cut_v = ratio < 2;
  for (int i = 0; i < (cut_u ? 2 : 1); ++i) {
    for (int j = 0; j < (cut_v ? 2 : 1); ++j)
      add(o + i * u + j * v, cut_u ? u : node.edge_u, cut_v ? v : node.edge_v);
  }
}

LightTree::Place LightTree::PlaceOn(int index, const Eigen::Vector3d& unit) const {
  double share = unit[2];
  while ((*this)[index].IsCluster()) {
    const LightNode& cluster = (*this)[index];
    const double first = (*this)[cluster.child[0]].area_m2 / cluster.area_m2;
    if (share < first) {
      share /= first;
      index = cluster.child[0];
    } else {
      share = (share - first) / (1 - first);
      index = cluster.child[1];
    }
  }
  return {PointOnElement((*this)[index], unit[0], unit[1]), (*this)[index].normal};
}

Eigen::Vector3d PointOnElement(const LightNode& element, double u, double v) {
  if (element.kind == FacetKind::kTriangle && u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return element.origin + u * element.edge_u + v * element.edge_v;
}

Probes ProbesOf(const LightNode& element) {
  const auto at = [&](double u, double v) -> Eigen::Vector3d {
    return element.origin + u * element.edge_u + v * element.edge_v;
  };
  if (element.kind == FacetKind::kTriangle)
    return {{at(1.0 / 6, 1.0 / 6), at(2.0 / 3, 1.0 / 6), at(1.0 / 6, 2.0 / 3), at(1.0 / 3, 1.0 / 3)}, 3};
  const double low = 0.5 - 0.5 / std::sqrt(3.0), high = 1 - low;
  return {{at(low, low), at(high, low), at(low, high), at(high, high)}, 4};
}

Eigen::Vector3d PointAroundProbe(const LightNode& element, int k, double u, double v) {
  if (element.kind == FacetKind::kParallelogram)
    return PointOnElement(element, 0.5 * (u + (k % 2 == 1 ? 1 : 0)), 0.5 * (v + (k >= 2 ? 1 : 0)));
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  // The third nearest to corner k is where its barycentric coordinate is the greatest.
  std::array<double, 3> share{1 - u - v, u, v};
  std::swap(share[static_cast<size_t>(k)], *std::max_element(share.begin(), share.end()));
  return element.origin + share[1] * element.edge_u + share[2] * element.edge_v;
}

MeanAndDeviation OfProbes(const std::array<double, 4>& values, int count) {
  double sum = 0, square = 0;
  for (int k = 0; k < count; ++k) {
    sum += values[static_cast<size_t>(k)];
    square += values[static_cast<size_t>(k)] * values[static_cast<size_t>(k)];
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, square / count - mean * mean))};
}

}  // namespace luxfit
