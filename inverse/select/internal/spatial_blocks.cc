#include "inverse/select/internal/spatial_blocks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace luxfit {
namespace {

using Indices = std::vector<int>::iterator;

class Halving {
 public:
  explicit Halving(const std::vector<Eigen::Vector3d>& places) : places_(places), block_(places.size()) {}

  void Cut(Indices begin, Indices end, int blocks) {
    Eigen::AlignedBox3d box;
    for (auto i = begin; i != end; ++i) box.extend(At(*i));
    int axis = 0;
    if (blocks < 2 || !(box.sizes().maxCoeff(&axis) > 0)) {
      for (auto i = begin; i != end; ++i) block_[static_cast<size_t>(*i)] = next_;
      ++next_;
      return;
    }
    // Equal places stay together: the cut lies between two distinct coordinates, as near the middle as they
    // allow.
    std::sort(begin, end,
              [&](int a, int b) { return At(a)[axis] != At(b)[axis] ? At(a)[axis] < At(b)[axis] : a < b; });
    const double median = At(*(begin + (end - begin) / 2))[axis];
    const auto below = [&](int i) { return At(i)[axis] < median; };
    const auto not_above = [&](int i) { return At(i)[axis] <= median; };
    Indices middle = std::partition_point(begin, end, below);
    if (middle == begin) middle = std::partition_point(begin, end, not_above);
    Cut(begin, middle, (blocks + 1) / 2);
    Cut(middle, end, blocks / 2);
  }

  std::vector<int> Take() { return std::move(block_); }

 private:
  const Eigen::Vector3d& At(int i) const { return places_[static_cast<size_t>(i)]; }

  const std::vector<Eigen::Vector3d>& places_;
  std::vector<int> block_;
  int next_ = 0;
};

}  // namespace

std::vector<int> SpatialBlocks(const std::vector<Eigen::Vector3d>& places, int blocks) {
  std::vector<int> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  Halving halving(places);
  if (!order.empty()) halving.Cut(order.begin(), order.end(), blocks);
  return halving.Take();
}

}  // namespace luxfit
