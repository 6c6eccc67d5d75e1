// Solves radiosity hierarchically: it cuts elements only where an error bound asks for it.
//
//   E_p = D_p + sum over links (p <- q) F_pq V_pq M_q,   M = rho E
//
// Every facet is the root of a tree of elements (halves or quarters of parallelograms, quarters of
// triangles). A binary tree of clusters gathers the facets, so that n facets need no n^2 links. A link joins
// any two nodes. Light gathered at a node is pushed down to its leaves, and the exitance of leaves is pulled
// up.
//
// A link is refined while the illuminance it leaves uncertain, weighted with the root of the receiver's share
// of all area, exceeds a threshold. The threshold falls until the estimated error is below error_percent. The
// estimate is one of the pointwise rms error (elements are constant). Over a leaf, errors of links between
// elements add, as light of neighbours falls off the same way. Errors of links with a cluster and of direct
// light add by squares, taken as independent.
//   uncertainty of a link:  variation of F V over the receiver (Lambert's formula at four points, rays from
//                           each to points of the source), of M over the source and over what is seen of it,
//                           extent of clusters
//   uncertainty of a leaf:  variation of direct light over it: shadow edges, near luminaires
// Light from and to a cluster goes by second-order spherical harmonics of the clamped cosine. Light within a
// cluster goes evenly to all members. Some rays of a link decide whether it is cut, others measure. After
// every pass the received light is scaled to the flux that left and landed, which rays from every leaf count.
// The mean thus keeps the energy, in open rooms too.
//
// Units are lx and metres, world frame; albedo by material of the scene in [0, 1). direct_lx must be callable
// from several threads. Leaves that lie inside a solid see nothing and stay dark.
//
// Throws std::invalid_argument for options or reflectances out of range. Where a limit (min_element_m,
// max_links) is reached, `converged` is false and `message` names it. Sources: Hanrahan, Salzman, Aupperle
// (1991), "A rapid hierarchical radiosity algorithm" (BF refinement); Smits, Arvo, Greenberg (1994), "A
// clustering algorithm for radiosity in complex environments"; Lischinski, Smits, Greenberg (1994), "Bounds
// and error estimates for radiosity"; Ramamoorthi and Hanrahan (2001), "An efficient representation for
// irradiance environment maps" (clamped cosine in spherical harmonics).
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_HIERARCHICAL_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_HIERARCHICAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "forward/room/scene.h"
#include "forward/room/visibility.h"

namespace luxfit {

// Returns the direct illuminance (lx) at a point of a surface with that normal.
using DirectLight = std::function<double(const Eigen::Vector3d& p_in_world, const Eigen::Vector3d& normal)>;

struct HierarchicalOptions {
  double error_percent = 5;         // estimated pointwise rms error, in percent of the mean illuminance
  double max_element_m = 0.5;       // start: narrower features of direct light may be missed
  double min_element_m = 0.02;      // no edge is cut below it
  int64_t max_links = 200'000'000;  // 24 bytes each
};

struct HierarchicalElement {
  int facet = 0;
  Eigen::Vector3d origin, edge_u, edge_v;  // as Facet
  Eigen::Vector3d center;
  double area_m2 = 0;
  double direct_lx = 0;       // mean of four points, or three in a triangle
  double illuminance_lx = 0;  // total
};

struct HierarchicalSolution {
  std::vector<HierarchicalElement> elements;  // the leaves
  double mean_illuminance_lx = 0;
  double error_percent = 0;  // estimated
  int64_t link_count = 0, cluster_link_count = 0;
  int64_t memory_bytes = 0;  // nodes and links
  int refinements = 0;       // how often the threshold fell
  int iterations = 0;        // gathering passes
  bool converged = false;
  std::string message;
};

HierarchicalSolution SolveHierarchical(const Scene& scene, const RayScene& rays,
                                       const Eigen::VectorXd& albedo, const DirectLight& direct_lx,
                                       const HierarchicalOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_HIERARCHICAL_H_
