#include "forward/mesh/internal/close_holes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <set>

namespace luxfit {
namespace {

class Hole {
 public:
  Hole(const std::vector<Side>& rim, ScanMesh& mesh, PlanarRegions& regions)
      : rim_(rim), mesh_(mesh), regions_(regions) {
    for (const Side& side : rim) {
      box_.extend(At(side.from));
      mean_ += At(side.from) / static_cast<double>(rim.size());
      const int region = RegionOf(side);
      if (region >= 0 && regions.area_m2[static_cast<size_t>(region)] > kScrapM2) around_.insert(region);
    }
  }
  double DiagonalM() const { return box_.diagonal().norm(); }

  void Close() {
    const int center = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.push_back(mean_);
    for (const Side& side : rim_) {
      const int region = Nearest(side);
      if (region < 0 ||
          !AddTriangle(side.to, side.from, center, regions_.material[static_cast<size_t>(region)], mesh_))
        continue;
      regions_.of_triangle.push_back(region);
      regions_.area_m2[static_cast<size_t>(region)] +=
          0.5 * mesh_.AreaNormal(mesh_.triangles.size() - 1).norm();
    }
  }

 private:
  static constexpr double kScrapM2 = 0.05;

  const Eigen::Vector3d& At(int vertex) const { return mesh_.vertices[static_cast<size_t>(vertex)]; }
  int RegionOf(const Side& side) const { return regions_.of_triangle[static_cast<size_t>(side.triangle)]; }

  // Returns the region that goes on at a side.
  int Nearest(const Side& side) const {
    const int own = RegionOf(side);
    if (around_.empty() || around_.count(own) > 0) return own;
    const Eigen::Vector3d middle = 0.5 * (At(side.from) + At(side.to));
    int nearest = own;
    double least = std::numeric_limits<double>::infinity();
    for (const int region : around_) {
      const double off = std::abs(regions_.planes[static_cast<size_t>(region)].Above(middle));
      if (off < least) least = off, nearest = region;
    }
    return nearest;
  }

  const std::vector<Side>& rim_;
  ScanMesh& mesh_;
  PlanarRegions& regions_;
  Eigen::AlignedBox3d box_;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  std::set<int> around_;  // regions that are no scraps
};

}  // namespace

int CloseHoles(double largest_hole_m, ScanMesh& mesh, PlanarRegions& regions) {
  int closed = 0;
  for (const std::vector<Side>& rim : RimsOf(mesh)) {
    Hole hole(rim, mesh, regions);
    if (rim.size() < 3 || hole.DiagonalM() > largest_hole_m) continue;
    hole.Close();
    ++closed;
  }
  FindNeighbours(mesh);
  return closed;
}

}  // namespace luxfit
