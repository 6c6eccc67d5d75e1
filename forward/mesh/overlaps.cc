#include "forward/mesh/mesh_check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "forward/room/internal/box_tree.h"
#include "forward/room/internal/facet_corners.h"

namespace luxfit {
namespace {

// Rays start 10 um above their surface (LiftedOff): nearer than that, two facets are in one place.
constexpr double kCoplanarM = 1.2e-5;
constexpr double kParallelCosine = 1 - 1e-6;  // small facets have inexact normals: the distance decides
constexpr double kMinWidthM = 2e-5;

using Polygon = std::vector<Eigen::Vector3d>;

struct Split {
  Polygon inside, outside;
};

// Splits a convex polygon by a plane; `outward` is the plane's unit normal.
Split SplitBy(const Polygon& polygon, const Eigen::Vector3d& on_plane, const Eigen::Vector3d& outward) {
  Split split;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = outward.dot(a - on_plane), db = outward.dot(b - on_plane);
    if (da <= 0) split.inside.push_back(a);
    if (da >= 0) split.outside.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      const Eigen::Vector3d at = a + da / (da - db) * (b - a);
      split.inside.push_back(at);
      split.outside.push_back(at);
    }
  }
  return split;
}

double AreaOf(const Polygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 2; i < polygon.size(); ++i)
    sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return 0.5 * sum.norm();
}

// Tells whether a polygon is too thin to be anything but rounding.
bool IsThin(const Polygon& polygon) {
  double longest = 0;
  for (const Eigen::Vector3d& p : polygon) longest = std::max(longest, (p - polygon[0]).norm());
  return polygon.size() < 3 || AreaOf(polygon) <= kMinWidthM * longest;
}

Polygon PolygonOf(const Facet& facet) {
  const FacetCorners corners = CornersOf(facet);
  return {corners.begin(), corners.end()};
}

// Holds the pieces of `polygon` outside the facet, and the one inside it.
struct Difference {
  std::vector<Polygon> outside;
  Polygon inside;
};
Difference Subtract(const Polygon& polygon, const Facet& facet) {
  const Polygon cutter = PolygonOf(facet);
  const Eigen::Vector3d normal = facet.Normal();
  Difference difference;
  difference.inside = polygon;
  for (size_t i = 0; i < cutter.size() && difference.inside.size() > 2; ++i) {
    const Eigen::Vector3d edge = cutter[(i + 1) % cutter.size()] - cutter[i];
    Split split = SplitBy(difference.inside, cutter[i], edge.cross(normal).normalized());
    difference.inside = std::move(split.inside);
    if (!IsThin(split.outside)) difference.outside.push_back(std::move(split.outside));
  }
  return difference;
}

bool LiesInPlane(const Facet& facet, const Eigen::Vector3d& on_plane, const Eigen::Vector3d& normal) {
  for (const Eigen::Vector3d& p : CornersOf(facet)) {
    if (std::abs(normal.dot(p - on_plane)) > kCoplanarM) return false;
  }
  return true;
}

bool AreCoplanar(const Facet& a, const Eigen::Vector3d& normal_a, const Facet& b,
                 const Eigen::Vector3d& normal_b) {
  return normal_a.dot(normal_b) > kParallelCosine &&
         (LiesInPlane(b, a.origin, normal_a) || LiesInPlane(a, b.origin, normal_b));
}

// Returns for each facet the area of its material in its plane.
std::vector<double> AreaInPlane(const Scene& scene, const std::vector<Eigen::Vector3d>& normals) {
  using Key = std::tuple<int64_t, int64_t, int64_t, int64_t, int>;
  const auto key = [&](size_t f) {
    const Eigen::Vector3d& n = normals[f];
    return Key{std::llround(1e3 * n.x()), std::llround(1e3 * n.y()), std::llround(1e3 * n.z()),
               std::llround(1e3 * n.dot(scene.facets[f].origin)), scene.facets[f].material};
  };
  std::map<Key, double> area;
  for (size_t f = 0; f < scene.facets.size(); ++f) area[key(f)] += scene.facets[f].AreaM2();
  std::vector<double> result;
  for (size_t f = 0; f < scene.facets.size(); ++f) result.push_back(area[key(f)]);
  return result;
}

}  // namespace

std::vector<FacetOverlap> FindOverlaps(const Scene& scene) {
  const size_t count = scene.facets.size();
  std::vector<Eigen::Vector3d> normals(count);
  std::vector<Eigen::AlignedBox3d> boxes(count);
  for (size_t f = 0; f < count; ++f) {
    normals[f] = scene.facets[f].Normal();
    boxes[f] = BoxOf(scene.facets[f], kCoplanarM);
  }
  const BoxTree tree(boxes);
  std::vector<std::vector<FacetOverlap>> of_facet(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t f) {
    tree.ForEach(boxes[f], [&](int other) {
      const size_t g = static_cast<size_t>(other);
      if (g <= f || !AreCoplanar(scene.facets[f], normals[f], scene.facets[g], normals[g])) return true;
      const Polygon common = Subtract(PolygonOf(scene.facets[f]), scene.facets[g]).inside;
      if (!IsThin(common)) of_facet[f].push_back({static_cast<int>(f), other, AreaOf(common)});
      return true;
    });
  });
  std::vector<FacetOverlap> overlaps;
  for (const std::vector<FacetOverlap>& list : of_facet)
    overlaps.insert(overlaps.end(), list.begin(), list.end());
  if (overlaps.empty()) return overlaps;
  const std::vector<double> area = AreaInPlane(scene, normals);
  for (FacetOverlap& overlap : overlaps) {
    // One strict order for all, so that three facets in one place do not cut each other away in a ring.
    const auto rank = [&](int f) { return std::pair(area[static_cast<size_t>(f)], f); };
    if (rank(overlap.below) < rank(overlap.on_top)) std::swap(overlap.below, overlap.on_top);
  }
  std::sort(overlaps.begin(), overlaps.end(), [](const FacetOverlap& a, const FacetOverlap& b) {
    return std::pair(a.below, a.on_top) < std::pair(b.below, b.on_top);
  });
  return overlaps;
}

Scene WithoutOverlaps(const Scene& scene) {
  const std::vector<FacetOverlap> overlaps = FindOverlaps(scene);
  if (overlaps.empty()) return scene;
  Scene result;
  result.materials = scene.materials;
  result.dropped_facets = scene.dropped_facets;
  auto next = overlaps.begin();
  for (size_t f = 0; f < scene.facets.size(); ++f) {
    const Facet& facet = scene.facets[f];
    if (next == overlaps.end() || static_cast<size_t>(next->below) != f) {
      result.facets.push_back(facet);
      continue;
    }
    std::vector<Polygon> pieces{PolygonOf(facet)};
    for (; next != overlaps.end() && static_cast<size_t>(next->below) == f; ++next) {
      std::vector<Polygon> remaining;
      for (const Polygon& piece : pieces) {
        Difference difference = Subtract(piece, scene.facets[static_cast<size_t>(next->on_top)]);
        if (IsThin(difference.inside)) {
          remaining.push_back(piece);  // not touched: keep it whole
        } else {
          std::move(difference.outside.begin(), difference.outside.end(), std::back_inserter(remaining));
        }
      }
      pieces = std::move(remaining);
    }
    for (const Polygon& piece : pieces) {
      const std::vector<Facet> facets = FacetsFromPolygon(piece, facet.material);
      result.facets.insert(result.facets.end(), facets.begin(), facets.end());
    }
  }
  return result;
}

}  // namespace luxfit
