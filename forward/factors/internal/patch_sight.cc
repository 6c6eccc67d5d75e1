#include "forward/factors/internal/patch_sight.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>

namespace luxfit {
namespace {

// Patches of one facet, contiguous in `order`, within one convex polygon.
struct Group {
  ConvexPolygon polygon;
  Eigen::Vector3d normal;
  int facet = 0;
  int first = 0, last = 0;    // of order
  int left = -1, right = -1;  // groups, -1: a single patch
};

struct Hierarchy {
  std::vector<Group> groups;
  std::vector<int> order;  // of patches
  std::vector<int> roots;  // one a facet that has patches
};

// Bounds of a patch in its facet's coordinates.
using Extent = Eigen::AlignedBox2d;

class Builder {
 public:
  explicit Builder(const Patches& patches) : patches_(patches) {
    const int n = static_cast<int>(patches.patches.size());
    for (int i = 0; i < n; ++i) {
      tree.order.push_back(i);
      extents_.push_back(ExtentOf(patches.patches[static_cast<size_t>(i)]));
    }
    // Patches of a facet follow each other.
    for (int first = 0; first < n;) {
      const int facet = patches.patches[static_cast<size_t>(first)].facet;
      int last = first;
      while (last < n && patches.patches[static_cast<size_t>(last)].facet == facet) ++last;
      tree.roots.push_back(Build(first, last));
      first = last;
    }
  }
  Hierarchy tree;

 private:
  Extent ExtentOf(const Patch& patch) const {
    const Facet& facet = patches_.facets[static_cast<size_t>(patch.facet)];
    Eigen::Matrix<double, 3, 2> edges;
    edges << facet.edge_u, facet.edge_v;
    const Eigen::Matrix2d normal_matrix = edges.transpose() * edges;
    Extent extent;
    const ConvexPolygon corners = MakePolygon(patch.origin, patch.edge_u, patch.edge_v, facet.kind);
    for (int k = 0; k < corners.count; ++k)
      extent.extend(normal_matrix.inverse() * (edges.transpose() * (corners[k] - facet.origin)));
    return extent;
  }

  int Build(int first, int last) {
    Extent extent;
    for (int i = first; i < last; ++i) extent.extend(extents_[Patch(i)]);
    const int index = static_cast<int>(tree.groups.size());
    tree.groups.emplace_back();
    Group group = MakeGroup(first, last, extent);
    if (last - first > 1) {
      const Facet& facet = patches_.facets[static_cast<size_t>(group.facet)];
      const Eigen::Array2d lengths =
          extent.sizes().array() * Eigen::Array2d(facet.edge_u.norm(), facet.edge_v.norm());
      const int axis = lengths[0] >= lengths[1] ? 0 : 1;
      const int middle = first + (last - first) / 2;
      const auto at = [&](int i) { return tree.order.begin() + i; };
      std::nth_element(at(first), at(middle), at(last), [&](int a, int b) {
        const Extent &ea = extents_[static_cast<size_t>(a)], &eb = extents_[static_cast<size_t>(b)];
        const double ca = ea.min()[axis] + ea.max()[axis], cb = eb.min()[axis] + eb.max()[axis];
        return ca != cb ? ca < cb : a < b;
      });
      group.left = Build(first, middle);
      group.right = Build(middle, last);
    }
    tree.groups[static_cast<size_t>(index)] = group;
    return index;
  }

  Group MakeGroup(int first, int last, const Extent& extent) const {
    const luxfit::Patch& patch = patches_.patches[Patch(first)];
    const Facet& facet = patches_.facets[static_cast<size_t>(patch.facet)];
    Group group;
    group.facet = patch.facet;
    group.normal = facet.Normal();
    group.first = first;
    group.last = last;
    if (last - first == 1) {
      group.polygon = MakePolygon(patch.origin, patch.edge_u, patch.edge_v, facet.kind);
      // A flipped triangle has both edges turned, so its corners keep their sense.
      return group;
    }
    const Eigen::Vector2d size = extent.sizes();
    group.polygon = MakePolygon(facet.PointAt(extent.min().x(), extent.min().y()), size[0] * facet.edge_u,
                                size[1] * facet.edge_v, FacetKind::kParallelogram);
    if (facet.kind == FacetKind::kTriangle) {  // what lies past the hypotenuse is not of the facet
      const Eigen::Vector3d past = group.normal.cross(facet.edge_v - facet.edge_u);
      group.polygon = InFrontOf(group.polygon, facet.origin + facet.edge_u, past.normalized());
    }
    return group;
  }

  size_t Patch(int i) const { return static_cast<size_t>(tree.order[static_cast<size_t>(i)]); }

  const Patches& patches_;
  std::vector<Extent> extents_;
};

constexpr int kPairsPerTask = 4096;

class Classifier {
 public:
  Classifier(const Hierarchy& tree, const std::vector<Blocker>& blockers, std::vector<Sight>& sight)
      : tree_(tree), blockers_(blockers), sight_(sight), count_(tree.order.size()) {}

  // All pairs between two groups; `candidates`: blockers that a shaft around them may meet.
  void Classify(int a_index, int b_index, const std::vector<int>& candidates) const {
    const Group &a = tree_.groups[static_cast<size_t>(a_index)],
                &b = tree_.groups[static_cast<size_t>(b_index)];
    Shaft shaft(a.polygon, a.normal, b.polygon, b.normal);
    if (shaft.FacesAway()) return Mark(a, b, Sight::kNone);
    std::vector<int> left;
    for (const int c : candidates) {
      const Blocker& blocker = blockers_[static_cast<size_t>(c)];
      if (blocker.facet != a.facet && blocker.facet != b.facet && !shaft.ClearlyExcludes(blocker))
        left.push_back(c);
    }
    if (left.empty()) return Mark(a, b, Sight::kFree);
    shaft.MakeSides();
    const auto excluded = [&](int c) { return shaft.SidesExclude(blockers_[static_cast<size_t>(c)]); };
    left.erase(std::remove_if(left.begin(), left.end(), excluded), left.end());
    if (left.empty()) return Mark(a, b, Sight::kFree);
    for (const int c : left) {
      if (shaft.IsBlockedBy(blockers_[static_cast<size_t>(c)])) return Mark(a, b, Sight::kNone);
    }
    const bool split_a = a.left >= 0 && (b.left < 0 || a.last - a.first >= b.last - b.first);
    const auto both = [&](int a_left, int b_left, int a_right, int b_right) {
      const auto one = [&] { Classify(a_left, b_left, left); };
      const auto other = [&] { Classify(a_right, b_right, left); };
      if ((a.last - a.first) * (b.last - b.first) > kPairsPerTask) {
        tbb::parallel_invoke(one, other);
      } else {
        one();
        other();
      }
    };
    if (split_a) {
      both(a.left, b_index, a.right, b_index);
    } else if (b.left >= 0) {
      both(a_index, b.left, a_index, b.right);
    } else {
      Mark(a, b, Sight::kPartial);
    }
  }

 private:
  void Mark(const Group& a, const Group& b, Sight value) const {
    for (int i = a.first; i < a.last; ++i) {
      for (int j = b.first; j < b.last; ++j) {
        const size_t p = Patch(i), q = Patch(j);
        sight_[p * count_ + q] = sight_[q * count_ + p] = value;
      }
    }
  }
  size_t Patch(int i) const { return static_cast<size_t>(tree_.order[static_cast<size_t>(i)]); }

  const Hierarchy& tree_;
  const std::vector<Blocker>& blockers_;
  std::vector<Sight>& sight_;
  size_t count_;
};

}  // namespace

PatchSight::PatchSight(const Patches& patches)
    : count_(patches.patches.size()), sight_(count_ * count_, Sight::kNone) {
  const std::vector<Blocker> blockers = BlockersOf(patches.facets);
  std::vector<int> all(blockers.size());
  std::iota(all.begin(), all.end(), 0);
  const Hierarchy tree = Builder(patches).tree;
  const Classifier classifier(tree, blockers, sight_);
  // Patches of one facet do not see each other. Pairs of facets write to different places.
  std::vector<std::array<int, 2>> pairs;
  for (size_t i = 0; i < tree.roots.size(); ++i) {
    for (size_t j = 0; j < i; ++j) pairs.push_back({tree.roots[i], tree.roots[j]});
  }
  tbb::parallel_for(size_t{0}, pairs.size(),
                    [&](size_t k) { classifier.Classify(pairs[k][0], pairs[k][1], all); });
}

}  // namespace luxfit
