#include "forward/mesh/internal/grow_planes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace luxfit {
namespace {

constexpr double kTurnedCosine = 0.766;      // 40 degrees
constexpr double kHardlyTurnedCosine = 0.5;  // normals beyond 60 degrees are of another surface: not averaged
constexpr double kSmallM2 = 0.01;

// Gathers the moments of triangles, weighted by area.
class PlaneFit {
 public:
  void Add(const ScanMesh& mesh, size_t t) {
    const Eigen::Vector3d normal = mesh.AreaNormal(t);
    const double area = 0.5 * normal.norm();
    facing_ += 0.5 * normal;
    area_ += area;
    for (size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& p = mesh.Corner(t, k);
      first_ += area / 3 * p;
      second_ += area / 3 * p * p.transpose();
    }
  }
  // Returns the plane through the middle that faces as the triangles do in the mean.
  Plane Facing() const {
    Plane plane;
    plane.normal = facing_.normalized();
    plane.offset_m = plane.normal.dot(first_ / area_);
    return plane;
  }

  Plane Solve() const {
    const Eigen::Vector3d mean = first_ / area_;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second_ / area_ - mean * mean.transpose());
    Plane plane;
    plane.normal = solver.eigenvectors().col(0);
    // A sliver's plane is any plane through it.
    if (std::abs(plane.normal.dot(facing_)) < kTurnedCosine * facing_.norm())
      plane.normal = facing_.normalized();
    if (plane.normal.dot(facing_) < 0) plane.normal = -plane.normal;
    plane.offset_m = plane.normal.dot(mean);
    return plane;
  }

 private:
  double area_ = 0;
  Eigen::Vector3d facing_ = Eigen::Vector3d::Zero(), first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
};

// Returns unit normals averaged with those of neighbours, three times, but not across edges.
std::vector<Eigen::Vector3d> SmoothNormals(const ScanMesh& mesh) {
  constexpr int kRounds = 3;
  std::vector<Eigen::Vector3d> area_normals(mesh.triangles.size()), smooth(mesh.triangles.size());
  for (size_t t = 0; t < smooth.size(); ++t) {
    area_normals[t] = mesh.AreaNormal(t);
    smooth[t] = area_normals[t].normalized();
  }
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Eigen::Vector3d> before = smooth;
    for (size_t t = 0; t < smooth.size(); ++t) {
      Eigen::Vector3d sum = area_normals[t].norm() * before[t];
      for (const int neighbour : mesh.across[t]) {
        if (neighbour < 0) continue;
        const auto n = static_cast<size_t>(neighbour);
        if (before[n].dot(before[t]) > kHardlyTurnedCosine) sum += area_normals[n].norm() * before[n];
      }
      if (sum.norm() > 0) smooth[t] = sum.normalized();
    }
  }
  return smooth;
}

class Grower {
 public:
  Grower(const ScanMesh& mesh, double off_plane_m)
      : mesh_(mesh), off_plane_m_(off_plane_m), normals_(SmoothNormals(mesh)) {
    result.of_triangle.assign(mesh.triangles.size(), -1);
    for (const size_t seed : FlattestFirst()) {
      if (result.of_triangle[seed] < 0) AddRegion(seed);
    }
  }
  PlanarRegions result;

 private:
  std::vector<size_t> FlattestFirst() const {
    std::vector<double> turn(mesh_.triangles.size(), 0);
    for (size_t t = 0; t < turn.size(); ++t) {
      for (const int n : mesh_.across[t])
        turn[t] += n < 0 ? 1 : 1 - normals_[t].dot(normals_[static_cast<size_t>(n)]);
    }
    std::vector<size_t> order(turn.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return turn[a] < turn[b]; });
    return order;
  }

  bool Takes(const Plane& plane, size_t t) const {
    if (plane.normal.dot(normals_[t]) < kTurnedCosine) return false;
    for (size_t k = 0; k < 3; ++k) {
      if (std::abs(plane.Above(mesh_.Corner(t, k))) > off_plane_m_) return false;
    }
    return true;
  }

  // Marks what the region takes from `seed` on, and returns it. `refits`: the plane follows the region as it grows.
  std::vector<size_t> Grow(size_t seed, int region, bool refits, Plane& plane) {
    std::vector<size_t> members{seed};
    PlaneFit fit;
    fit.Add(mesh_, seed);
    result.of_triangle[seed] = region;
    size_t next_fit = 2;
    for (size_t at = 0; at < members.size(); ++at) {
      for (const int neighbour : mesh_.across[members[at]]) {
        if (neighbour < 0) continue;
        const auto n = static_cast<size_t>(neighbour);
        if (result.of_triangle[n] >= 0 || mesh_.material[n] != mesh_.material[seed] || !Takes(plane, n))
          continue;
        result.of_triangle[n] = region;
        members.push_back(n);
        fit.Add(mesh_, n);
        if (refits && members.size() >= next_fit) {
          plane = fit.Solve();
          next_fit *= 2;
        }
      }
    }
    plane = fit.Solve();
    return members;
  }

  void AddRegion(size_t seed) {
    const int region = static_cast<int>(result.planes.size());
    Plane plane;
    plane.normal = normals_[seed];
    plane.offset_m =
        plane.normal.dot((mesh_.Corner(seed, 0) + mesh_.Corner(seed, 1) + mesh_.Corner(seed, 2)) / 3);
    std::vector<size_t> members = Grow(seed, region, true, plane);
    for (const size_t t : members) result.of_triangle[t] = -1;
    members = Grow(seed, region, false, plane);
    double area_m2 = 0;
    for (const size_t t : members) area_m2 += 0.5 * mesh_.AreaNormal(t).norm();
    result.planes.push_back(plane);
    result.area_m2.push_back(area_m2);
    result.material.push_back(mesh_.material[seed]);
  }

  const ScanMesh& mesh_;
  double off_plane_m_;
  std::vector<Eigen::Vector3d> normals_;
};

// Joins small regions to neighbours, smallest first.
class Joiner {
 public:
  Joiner(const ScanMesh& mesh, double off_plane_m, PlanarRegions& regions)
      : mesh_(mesh), off_plane_m_(off_plane_m), regions_(regions), members_(regions.planes.size()) {
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
      members_[static_cast<size_t>(regions.of_triangle[t])].push_back(t);
    std::vector<size_t> order(regions.planes.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return regions.area_m2[a] < regions.area_m2[b]; });
    for (const size_t region : order) {
      if (regions_.area_m2[region] < kSmallM2) Join(region);
    }
  }

 private:
  void Join(size_t small) {
    std::map<size_t, double> border_m;
    for (const size_t t : members_[small]) {
      for (size_t k = 0; k < 3; ++k) {
        const int neighbour = mesh_.across[t][k];
        if (neighbour < 0) continue;
        const auto other = static_cast<size_t>(regions_.of_triangle[static_cast<size_t>(neighbour)]);
        if (other != small && Hold(other, small))
          border_m[other] += (mesh_.Corner(t, (k + 1) % 3) - mesh_.Corner(t, k)).norm();
      }
    }
    if (border_m.empty()) return;
    const size_t into = std::max_element(border_m.begin(), border_m.end(), [](const auto& x, const auto& y) {
                          return x.second < y.second;
                        })->first;
    for (const size_t t : members_[small]) regions_.of_triangle[t] = static_cast<int>(into);
    members_[into].insert(members_[into].end(), members_[small].begin(), members_[small].end());
    regions_.area_m2[into] += regions_.area_m2[small];
    members_[small].clear();
    regions_.area_m2[small] = 0;
  }

  bool Hold(size_t other, size_t small) const {
    constexpr double kLeavesFactor = 2;
    if (regions_.material[other] != regions_.material[small]) return false;
    const Plane& plane = regions_.planes[other];
    return std::all_of(members_[small].begin(), members_[small].end(), [&](size_t t) {
      if (plane.normal.dot(mesh_.AreaNormal(t)) <= 0) return false;
      for (size_t k = 0; k < 3; ++k) {
        if (std::abs(plane.Above(mesh_.Corner(t, k))) > kLeavesFactor * off_plane_m_) return false;
      }
      return true;
    });
  }

  const ScanMesh& mesh_;
  double off_plane_m_;
  PlanarRegions& regions_;
  std::vector<std::vector<size_t>> members_;
};

// Numbers the regions that are left, largest first.
PlanarRegions Numbered(const PlanarRegions& regions) {
  std::vector<size_t> order;
  for (size_t r = 0; r < regions.planes.size(); ++r) {
    if (regions.area_m2[r] > 0) order.push_back(r);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return regions.area_m2[a] > regions.area_m2[b]; });
  PlanarRegions numbered;
  std::vector<int> number(regions.planes.size(), -1);
  for (const size_t r : order) {
    number[r] = static_cast<int>(numbered.planes.size());
    numbered.planes.push_back(regions.planes[r]);
    numbered.area_m2.push_back(regions.area_m2[r]);
    numbered.material.push_back(regions.material[r]);
  }
  for (const int r : regions.of_triangle)
    numbered.of_triangle.push_back(r < 0 ? -1 : number[static_cast<size_t>(r)]);
  return numbered;
}

}  // namespace

PlanarRegions GatherSmall(const ScanMesh& mesh, const PlanarRegions& regions, double cell_m) {
  const double small_m2 = cell_m * cell_m / 4;
  std::vector<Eigen::Vector3d> first(regions.planes.size());
  for (size_t t = mesh.triangles.size(); t-- > 0;) {
    if (regions.of_triangle[t] >= 0) first[static_cast<size_t>(regions.of_triangle[t])] = mesh.Corner(t, 0);
  }
  PlanarRegions gathered = regions;
  std::map<std::array<int, 5>, size_t> region_of;  // cell, way it faces, material
  std::vector<size_t> into(regions.planes.size());
  for (size_t r = 0; r < into.size(); ++r) {
    into[r] = r;
    if (regions.area_m2[r] >= small_m2) continue;
    const Eigen::Array3d cell = (first[r].array() / cell_m).floor();
    const Eigen::Vector3d& normal = regions.planes[r].normal;
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const std::array<int, 5> key{static_cast<int>(cell.x()), static_cast<int>(cell.y()),
                                 static_cast<int>(cell.z()), 2 * axis + (normal[axis] > 0 ? 1 : 0),
                                 regions.material[r]};
    into[r] = region_of.try_emplace(key, r).first->second;
    if (into[r] == r) continue;
    gathered.area_m2[into[r]] += regions.area_m2[r];
    gathered.area_m2[r] = 0;
  }
  std::vector<PlaneFit> fits(into.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    int& of = gathered.of_triangle[t];
    if (of < 0) continue;
    of = static_cast<int>(into[static_cast<size_t>(of)]);
    fits[static_cast<size_t>(of)].Add(mesh, t);
  }
  for (size_t r = 0; r < into.size(); ++r) {
    if (gathered.area_m2[r] > regions.area_m2[r]) gathered.planes[r] = fits[r].Facing();
  }
  return Numbered(gathered);
}

PlanarRegions GrowPlanes(const ScanMesh& mesh, double off_plane_m) {
  PlanarRegions regions = Grower(mesh, off_plane_m).result;
  const Joiner joined(mesh, off_plane_m, regions);
  return Numbered(regions);
}

}  // namespace luxfit
