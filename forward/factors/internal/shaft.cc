#include "forward/factors/internal/shaft.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace luxfit {
namespace {

constexpr double kTolerance = 1e-7;  // m: what touches does not block

template <typename Test>
bool All(const ConvexPolygon& polygon, const Test& test) {
  for (int i = 0; i < polygon.count; ++i) {
    if (!test(polygon[i])) return false;
  }
  return true;
}

bool IsInside(const ConvexPolygon& polygon, const Eigen::Vector3d& normal, const Eigen::Vector3d& p) {
  for (int i = 0; i < polygon.count; ++i) {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d edge = polygon[(i + 1) % polygon.count] - a;
    if (normal.cross(edge).dot(p - a) < kTolerance * edge.norm()) return false;
  }
  return true;
}

Eigen::AlignedBox3d BoxOf(const ConvexPolygon& polygon) {
  Eigen::AlignedBox3d box;
  for (int i = 0; i < polygon.count; ++i) box.extend(polygon[i]);
  return box;
}

// Tests whether a point lies behind a plane, or in it.
auto Behind(const Eigen::Vector3d& normal, double offset) {
  return [&normal, offset](const Eigen::Vector3d& p) { return normal.dot(p) - offset <= kTolerance; };
}

}  // namespace

std::vector<Blocker> BlockersOf(const std::vector<Facet>& facets) {
  std::vector<Blocker> blockers;
  blockers.reserve(facets.size());
  for (const Facet& facet : facets) {
    const ConvexPolygon polygon = MakePolygon(facet.origin, facet.edge_u, facet.edge_v, facet.kind);
    blockers.push_back({polygon, facet.Normal(), BoxOf(polygon), static_cast<int>(blockers.size()),
                        facet.covered_share >= 1});
  }
  return blockers;
}

Shaft::Shaft(const ConvexPolygon& a, const Eigen::Vector3d& normal_a, const ConvexPolygon& b,
             const Eigen::Vector3d& normal_b)
    : a_(a), b_(b), normal_a_(normal_a), normal_b_(normal_b), box_(BoxOf(a).merged(BoxOf(b))) {}

void Shaft::MakeSides() {
  AddSides(a_, normal_a_, b_);
  AddSides(b_, normal_b_, a_);
}

void Shaft::AddSides(const ConvexPolygon& base, const Eigen::Vector3d& normal, const ConvexPolygon& tip) {
  for (int i = 0; i < base.count; ++i) {
    const Eigen::Vector3d& start = base[i];
    const Eigen::Vector3d outward = (base[(i + 1) % base.count] - start).cross(normal);
    // Seen along the edge, the tip's corner that leans outward most bounds the hull on this side of the base.
    Eigen::Vector2d extreme;  // outward, up
    bool in_front = true;
    for (int k = 0; k < tip.count && in_front; ++k) {
      const Eigen::Vector3d d = tip[k] - start;
      const Eigen::Vector2d corner(outward.dot(d), normal.dot(d));
      in_front = corner[1] > kTolerance;
      if (k == 0 || corner[0] * extreme[1] > extreme[0] * corner[1]) extreme = corner;
    }
    if (!in_front) continue;  // of a tip that reaches behind the base this side bounds nothing
    const Eigen::Vector3d inward = (extreme[0] * normal - extreme[1] * outward).normalized();
    sides_[static_cast<size_t>(side_count_++)] = {inward, inward.dot(start)};
  }
}

bool Shaft::FacesAway() const {
  const auto behind = [](const Eigen::Vector3d& origin, const Eigen::Vector3d& normal) {
    return [&origin, &normal](const Eigen::Vector3d& p) { return normal.dot(p - origin) <= kTolerance; };
  };
  return All(b_, behind(a_[0], normal_a_)) || All(a_, behind(b_[0], normal_b_));
}

bool Shaft::ClearlyExcludes(const Blocker& blocker) const {
  if (((blocker.box.min() - box_.max()).array() > kTolerance).any() ||
      ((box_.min() - blocker.box.max()).array() > kTolerance).any())
    return true;
  const ConvexPolygon& c = blocker.polygon;
  if (All(c, Behind(normal_a_, normal_a_.dot(a_[0]))) || All(c, Behind(normal_b_, normal_b_.dot(b_[0]))))
    return true;
  // The facet's own plane has both polygons on one side.
  const double offset = blocker.normal.dot(c[0]);
  const auto below = Behind(blocker.normal, offset);
  const auto above = [&](const Eigen::Vector3d& p) { return blocker.normal.dot(p) - offset >= -kTolerance; };
  return (All(a_, below) && All(b_, below)) || (All(a_, above) && All(b_, above));
}

bool Shaft::SidesExclude(const Blocker& blocker) const {
  for (int k = 0; k < side_count_; ++k) {
    const Plane& side = sides_[static_cast<size_t>(k)];
    if (All(blocker.polygon, Behind(side.normal, side.offset))) return true;
  }
  return false;
}

bool Shaft::IsBlockedBy(const Blocker& blocker) const {
  if (!blocker.is_whole) return false;
  const double offset = blocker.normal.dot(blocker.polygon[0]);
  const auto below = [&](const Eigen::Vector3d& p) { return blocker.normal.dot(p) - offset < -kTolerance; };
  const auto above = [&](const Eigen::Vector3d& p) { return blocker.normal.dot(p) - offset > kTolerance; };
  if (!(All(a_, below) && All(b_, above)) && !(All(a_, above) && All(b_, below))) return false;
  for (int i = 0; i < a_.count; ++i) {
    const double ha = blocker.normal.dot(a_[i]) - offset;
    for (int k = 0; k < b_.count; ++k) {
      const double hb = blocker.normal.dot(b_[k]) - offset;
      if (!IsInside(blocker.polygon, blocker.normal, a_[i] + ha / (ha - hb) * (b_[k] - a_[i]))) return false;
    }
  }
  return true;
}

}  // namespace luxfit
