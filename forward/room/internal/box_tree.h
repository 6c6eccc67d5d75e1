// Finds which of many boxes meet a given one, by a tree of boxes that is split at the median.
//
// Source: Wald (2007), "On fast construction of SAH-based bounding volume hierarchies" (the object median,
// its simplest rule).
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_BOX_TREE_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_BOX_TREE_H_

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace luxfit {

class BoxTree {
 public:
  explicit BoxTree(std::vector<Eigen::AlignedBox3d> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!boxes_.empty()) Build(0, static_cast<int>(boxes_.size()));
  }

  // Calls use(index) for every box that meets `box`, touching included, until it returns false.
  template <typename Use>
  void ForEach(const Eigen::AlignedBox3d& box, const Use& use) const {
    if (nodes_.empty()) return;
    std::array<int, 64> stack;  // the tree is balanced: its depth is below 32
    int depth = 0;
    stack[0] = 0;
    while (depth >= 0) {
      const Node& node = nodes_[static_cast<size_t>(stack[static_cast<size_t>(depth--)])];
      if (!node.box.intersects(box)) continue;
      if (node.right > 0) {
        stack[static_cast<size_t>(++depth)] = node.right;
        stack[static_cast<size_t>(++depth)] = static_cast<int>(&node - nodes_.data()) + 1;
        continue;
      }
      for (int i = node.begin; i < node.end; ++i) {
        const int index = order_[static_cast<size_t>(i)];
        if (boxes_[static_cast<size_t>(index)].intersects(box) && !use(index)) return;
      }
    }
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int right = 0;  // 0: a leaf; the left child follows its parent
    int begin = 0, end = 0;
  };

  void Build(int begin, int end) {
    constexpr int kLeaf = 4;
    const size_t at = nodes_.size();
    nodes_.push_back({{}, 0, begin, end});
    Eigen::AlignedBox3d centers;
    for (int i = begin; i < end; ++i) {
      const Eigen::AlignedBox3d& box = boxes_[static_cast<size_t>(order_[static_cast<size_t>(i)])];
      nodes_[at].box.extend(box);
      centers.extend(box.center());
    }
    if (end - begin <= kLeaf) return;
    Eigen::Index axis;
    centers.sizes().maxCoeff(&axis);
    const int middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) {
                       return boxes_[static_cast<size_t>(a)].center()[axis] <
                              boxes_[static_cast<size_t>(b)].center()[axis];
                     });
    Build(begin, middle);
    nodes_[at].right = static_cast<int>(nodes_.size());
    Build(middle, end);
  }

  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_BOX_TREE_H_
