// A scan of a scene, as depth cameras make it: fine triangles with bumps, jitter and holes, without materials.
//
//   p' = p + bump sum_k a_k sin(w_k . p + phi_k) + jitter n(p)        n: normal numbers drawn by place
//
// Displacements depend on the place alone, so that facets which share an edge with the same corners stay joined. Metres.
#ifndef LUXFIT_TESTS_SUPPORT_FORWARD_SCAN_OF_H_
#define LUXFIT_TESTS_SUPPORT_FORWARD_SCAN_OF_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "forward/room/internal/sampling.h"
#include "forward/room/scene.h"

namespace luxfit::support {

struct ScanOptions {
  double edge_m = 0.09;
  double bump_m = 0.005, jitter_m = 0.002;  // 1 sigma, each axis
  double bump_number_per_m =
      9;  // wave numbers, 1 sigma: bumps are alike over 0.1 m, as in depth cameras' scans
  double hole_share = 0.03, hole_radius_m = 0.25;
};

namespace scan {

// The displacement of a place.
class Warp {
 public:
  Warp(const ScanOptions& options, std::mt19937_64& rng) : options_(options) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> phase(0, 6.28);
    for (Wave& wave : waves_) {
      for (int axis = 0; axis < 3; ++axis) {
        wave.number[axis] = options.bump_number_per_m * normal(rng);
        wave.along[axis] = normal(rng);
      }
      wave.phase = phase(rng);
    }
  }

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const {
    Eigen::Vector3d moved = p;
    for (const Wave& wave : waves_)
      moved += options_.bump_m * std::sqrt(2.0 / waves_.size()) * std::sin(wave.number.dot(p) + wave.phase) *
               wave.along;
    uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis)
      place = Mix(place + static_cast<uint64_t>(std::lround(1e4 * p[axis]) + 1000000));
    for (int axis = 0; axis < 3; ++axis) {
      // The sum of twelve uniform numbers is nearly normal.
      double sum = -6;
      for (int k = 0; k < 12; ++k) sum += UnitFrom(place = Mix(place));
      moved[axis] += options_.jitter_m * sum;
    }
    return moved;
  }

 private:
  struct Wave {
    Eigen::Vector3d number, along;
    double phase = 0;
  };
  ScanOptions options_;
  std::array<Wave, 40> waves_;
};

inline void AddFacet(const Facet& facet, const Warp& warp, double edge_m, Scene& scan) {
  const bool is_triangle = facet.kind == FacetKind::kTriangle;
  double u_m = facet.edge_u.norm(), v_m = facet.edge_v.norm();
  if (is_triangle) u_m = v_m = std::max({u_m, v_m, (facet.edge_u - facet.edge_v).norm()});
  const int n = static_cast<int>(std::ceil(u_m / edge_m)), m = static_cast<int>(std::ceil(v_m / edge_m));
  const auto at = [&](int i, int j) {
    return warp(facet.PointAt(static_cast<double>(i) / n, static_cast<double>(j) / m));
  };
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    scan.facets.push_back({FacetKind::kTriangle, a, b - a, c - a, 0});
  };
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      if (is_triangle && i + j >= n) continue;
      add(at(i, j), at(i + 1, j), at(i, j + 1));
      if (!is_triangle || i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

}  // namespace scan

inline Scene ScanOf(const Scene& scene, const ScanOptions& options, std::mt19937_64& rng) {
  Scene scan;
  scan.materials = {kDefaultMaterial};
  const scan::Warp warp(options, rng);
  for (const Facet& facet : scene.facets) scan::AddFacet(facet, warp, options.edge_m, scan);
  const auto least = static_cast<size_t>((1 - options.hole_share) * static_cast<double>(scan.facets.size()));
  std::uniform_int_distribution<size_t> any(0, scan.facets.size() - 1);
  while (scan.facets.size() > least) {
    const Eigen::Vector3d center = scan.facets[any(rng) % scan.facets.size()].origin;
    scan.facets.erase(
        std::remove_if(scan.facets.begin(), scan.facets.end(),
                       [&](const Facet& f) { return (f.origin - center).norm() < options.hole_radius_m; }),
        scan.facets.end());
  }
  return scan;
}

// Writes triangles to an OBJ file, in metres, corners to a micrometre.
inline void WriteTriangles(const Scene& scan, const std::string& path) {
  std::ofstream file(path);
  file.setf(std::ios::fixed);
  file.precision(6);
  for (const Facet& facet : scan.facets) {
    for (const Eigen::Vector3d& p : {facet.PointAt(0, 0), facet.PointAt(1, 0), facet.PointAt(0, 1)})
      file << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    file << "f -3 -2 -1\n";
  }
}

}  // namespace luxfit::support

#endif  // LUXFIT_TESTS_SUPPORT_FORWARD_SCAN_OF_H_
