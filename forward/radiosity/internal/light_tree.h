// Builds the tree of hierarchical radiosity: clusters of facets, facets, and the elements they are cut into.
//
// Nodes are numbered so that children follow their parents. Clusters come first (node 0 is the scene, unless
// it is a single facet), then facets in the scene's order, then elements as they are made. Lengths are in m.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_TREE_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_TREE_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "forward/room/scene.h"

namespace luxfit {

struct LightNode {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // clusters: centre of the bounds
  // Elements only.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), origin = normal, edge_u = normal, edge_v = normal;
  double area_m2 = 0;
  double radius_m = 0;  // radius of the sphere around centre that holds it
  std::array<int, 4> child{{-1, -1, -1, -1}};
  int child_count = 0;
  int facet = -1;                        // -1: a cluster
  int first_member = 0, end_member = 0;  // clusters only: LightTree::MemberOf of their facets
  FacetKind kind = FacetKind::kParallelogram;

  bool IsCluster() const { return facet < 0; }
  bool IsLeaf() const { return child_count == 0; }
  double LongestEdge() const;
};

class LightTree {
 public:
  explicit LightTree(const Scene& scene);
  const LightNode& operator[](int i) const { return nodes_[static_cast<size_t>(i)]; }
  int size() const { return static_cast<int>(nodes_.size()); }
  int cluster_count() const { return cluster_count_; }
  // Returns a facet's number in an order in which those of a cluster follow each other.
  int MemberOf(int facet) const { return member_of_[static_cast<size_t>(facet)]; }
  // Cuts a leaf: a parallelogram in two across its longer edge where that is more than twice the other, else
  // into four.
  void Split(int node);
  // Returns a point of a node, by area; unit in [0, 1)^3.
  struct Place {
    Eigen::Vector3d point, normal;
  };
  Place PlaceOn(int node, const Eigen::Vector3d& unit) const;

 private:
  int AddCluster(const Scene& scene, std::vector<int>& facets, int first_member, int end_member);
  std::vector<LightNode> nodes_;
  std::vector<int> member_of_;
  int cluster_count_ = 0;
};

// Returns point (u, v) in [0, 1]^2 of an element; over triangles with even density too.
Eigen::Vector3d PointOnElement(const LightNode& element, double u, double v);

// Holds points of an element whose equal weights give the mean of a cubic function (2 x 2 Gauss points of a
// parallelogram) or a quadratic one (3 points of a triangle). They hence also give the pointwise variance of
// a linear one.
struct Probes {
  std::array<Eigen::Vector3d, 4> points;
  int count = 4;
};
Probes ProbesOf(const LightNode& element);
// Returns the point (u, v) of the part of an element around its k-th probe: a quarter or a third.
Eigen::Vector3d PointAroundProbe(const LightNode& element, int k, double u, double v);

struct MeanAndDeviation {
  double mean = 0, deviation = 0;  // deviation: rms
};
MeanAndDeviation OfProbes(const std::array<double, 4>& values, int count);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_LIGHT_TREE_H_
