#include "calib/register/internal/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace luxfit {
namespace {

// Returns the nearest point, by the region of the triangle's plane into which the point's foot falls.
Eigen::Vector3d NearestOnTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp),
               d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return sum > 0 ? a + (vb * ab + vc * ac) / sum : a;
}

}  // namespace

TriangleTree::TriangleTree(const Eigen::Matrix3Xd& vertices, const Eigen::Matrix3Xi& triangles)
    : vertices_(vertices), triangles_(triangles), order_(static_cast<std::size_t>(triangles.cols())) {
  std::iota(order_.begin(), order_.end(), 0);
  Build(0, static_cast<int>(order_.size()));
}

int TriangleTree::Build(int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box, middles;
  const auto middle = [this](int triangle) -> Eigen::Vector3d {
    return (Corner(triangle, 0) + Corner(triangle, 1) + Corner(triangle, 2)) / 3;
  };
  for (int i = begin; i < end; ++i) {
    const int triangle = order_[static_cast<std::size_t>(i)];
    for (int corner = 0; corner < 3; ++corner) box.extend(Corner(triangle, corner));
    middles.extend(middle(triangle));
  }
  constexpr int kLeaf = 4;
  Node node;
  node.box = box;
  node.begin = begin;
  node.end = end;
  if (end - begin > kLeaf) {
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const int half = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](int a, int b) { return middle(a)[axis] < middle(b)[axis]; });
    node.left = Build(begin, half);
    node.right = Build(half, end);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

void TriangleTree::Search(int index, const Eigen::Vector3d& p, NearestPoint& best) const {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (node.box.squaredExteriorDistance(p) >= best.squared_distance) return;
  if (node.left < 0) {
    for (int i = node.begin; i < node.end; ++i) {
      const int triangle = order_[static_cast<std::size_t>(i)];
      const Eigen::Vector3d q =
          NearestOnTriangle(p, Corner(triangle, 0), Corner(triangle, 1), Corner(triangle, 2));
      const double squared = (q - p).squaredNorm();
      if (squared < best.squared_distance) best = {q, triangle, squared};
    }
    return;
  }
  const Node& left = nodes_[static_cast<std::size_t>(node.left)];
  const Node& right = nodes_[static_cast<std::size_t>(node.right)];
  const bool left_first = left.box.squaredExteriorDistance(p) <= right.box.squaredExteriorDistance(p);
  Search(left_first ? node.left : node.right, p, best);
  Search(left_first ? node.right : node.left, p, best);
}

NearestPoint TriangleTree::Nearest(const Eigen::Vector3d& p) const {
  NearestPoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  Search(0, p, best);
  return best;
}

Eigen::Vector3d TriangleTree::Normal(int triangle) const {
  const Eigen::Vector3d normal =
      (Corner(triangle, 1) - Corner(triangle, 0)).cross(Corner(triangle, 2) - Corner(triangle, 0));
  const double length = normal.norm();
  return length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
}

}  // namespace luxfit
