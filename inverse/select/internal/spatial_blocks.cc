#include "inverse/select/internal/spatial_blocks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

namespace luxfit {
namespace {

using DistinctPlace = std::array<double, 3>;
using DistinctPlaces = std::vector<DistinctPlace>::iterator;

class Halving {
 public:
  // Cuts distinct places. `blocks`: from 1 to their number.
  void Cut(DistinctPlaces begin, DistinctPlaces end, int blocks) {
    if (blocks == 1) {
      for (auto p = begin; p != end; ++p) block_[*p] = next_;
      ++next_;
      return;
    }
    Eigen::AlignedBox3d box;
    for (auto p = begin; p != end; ++p) box.extend(Eigen::Vector3d((*p)[0], (*p)[1], (*p)[2]));
    size_t axis = 0;
    box.sizes().maxCoeff(&axis);
    std::sort(begin, end, [axis](const DistinctPlace& a, const DistinctPlace& b) {
      return a[axis] != b[axis] ? a[axis] < b[axis] : a < b;
    });
    const int lower = (blocks + 1) / 2;
    const DistinctPlaces middle = begin + (end - begin) * lower / blocks;
    Cut(begin, middle, lower);
    Cut(middle, end, blocks - lower);
  }

  int BlockOf(const DistinctPlace& place) const { return block_.at(place); }

 private:
  std::map<DistinctPlace, int> block_;
  int next_ = 0;
};

}  // namespace

std::vector<int> SpatialBlocks(const std::vector<Eigen::Vector3d>& places, int blocks) {
  std::vector<DistinctPlace> all;
  all.reserve(places.size());
  for (const Eigen::Vector3d& p : places) all.push_back({p.x(), p.y(), p.z()});
  std::vector<DistinctPlace> distinct = all;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  Halving halving;
  if (!distinct.empty())
    halving.Cut(distinct.begin(), distinct.end(), std::min(blocks, static_cast<int>(distinct.size())));
  std::vector<int> block;
  block.reserve(all.size());
  for (const DistinctPlace& p : all) block.push_back(halving.BlockOf(p));
  return block;
}

}  // namespace luxfit
