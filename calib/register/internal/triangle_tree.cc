#include "calib/register/internal/triangle_tree.h"

#include <limits>
#include <numeric>
#include <vector>

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
    : vertices_(vertices), triangles_(triangles) {
  std::vector<int> indices(static_cast<std::size_t>(triangles.cols()));
  std::iota(indices.begin(), indices.end(), 0);
  std::vector<Eigen::AlignedBox3d> boxes(indices.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) boxes[i].extend(Corner(indices[i], corner));
  }
  tree_.init(indices.begin(), indices.end(), boxes.begin(), boxes.end());
}

Eigen::Vector3d TriangleTree::NearestOn(int triangle, const Eigen::Vector3d& p) const {
  return NearestOnTriangle(p, Corner(triangle, 0), Corner(triangle, 1), Corner(triangle, 2));
}

NearestPoint TriangleTree::Nearest(const Eigen::Vector3d& p) const {
  struct Squared {
    using Scalar = double;
    const TriangleTree& tree;
    Eigen::Vector3d p;
    NearestPoint best = {Eigen::Vector3d::Zero(), -1, std::numeric_limits<double>::infinity()};

    double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return box.squaredExteriorDistance(p); }
    double minimumOnObject(int triangle) {
      const Eigen::Vector3d q = tree.NearestOn(triangle, p);
      const double squared = (q - p).squaredNorm();
      if (squared < best.squared_distance) best = {q, triangle, squared};
      return squared;
    }
  } squared{*this, p};
  Eigen::BVMinimize(tree_, squared);
  return squared.best;
}

Eigen::Vector3d TriangleTree::Normal(int triangle) const {
  const Eigen::Vector3d normal =
      (Corner(triangle, 1) - Corner(triangle, 0)).cross(Corner(triangle, 2) - Corner(triangle, 0));
  const double length = normal.norm();
  return length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
}

}  // namespace luxfit
