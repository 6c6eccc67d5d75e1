#include "forward/internal/light_links.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "forward/internal/sampling.h"
#include "forward/polygon_factor.h"

namespace luxfit {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPlaneTolerance = 1e-9;  // m

// Whether all of `node` lies behind the plane of `element`.
bool IsBehind(const LightNode& node, const LightNode& element) {
  const double height = element.normal.dot(node.center - element.center);
  if (height < -node.radius_m) return true;
  if (height > node.radius_m || node.IsCluster()) return false;
  const auto below = [&](const Eigen::Vector3d& corner) {
    return element.normal.dot(corner - element.center) <= kPlaneTolerance;
  };
  return below(node.origin) && below(node.origin + node.edge_u) && below(node.origin + node.edge_v) &&
         (node.kind == FacetKind::kTriangle || below(node.origin + node.edge_u + node.edge_v));
}

// Points of the unit cube, different for every link: an additive sequence (x^4 = x + 1) with a hashed start.
class UnitPoints {
 public:
  UnitPoints(int receiver, int source) {
    uint64_t hash = Mix(Mix(static_cast<uint64_t>(receiver)) + static_cast<uint64_t>(source));
    for (double& x : start_) x = UnitFrom(hash = Mix(hash));
  }
  // The first for the receiver's end, the second for the source's.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> At(int i) const {
    static constexpr double kStep[6] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703,
                                        0.7548776662466927, 0.5698402909980532, 0.6180339887498949};
    double x[6];
    for (int k = 0; k < 6; ++k) {
      x[k] = start_[k] + i * kStep[k];
      x[k] -= std::floor(x[k]);
    }
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
  }

 private:
  double start_[6];
};

struct RayTest {
  bool facing = false, visible = false;
};

RayTest TestRay(const RayScene& rays, const LightTree::Place& from, const LightTree::Place& to) {
  const Eigen::Vector3d d = to.point - from.point;
  if (from.normal.dot(d) <= kPlaneTolerance || to.normal.dot(d) >= -kPlaneTolerance) return {};
  return {true, !rays.Occluded(LiftedOff(from.point, from.normal), LiftedOff(to.point, to.normal))};
}

// Of the source, seen from around each probe of the receiver.
struct ProbeVisibility {
  std::array<int, 4> facing{}, visible{};

  int FacingSum() const { return facing[0] + facing[1] + facing[2] + facing[3]; }
  int VisibleSum() const { return visible[0] + visible[1] + visible[2] + visible[3]; }
  bool IsPartial() const { return VisibleSum() > 0 && VisibleSum() < FacingSum(); }
  double Of(size_t k) const {
    if (facing[k] > 0) return static_cast<double>(visible[k]) / facing[k];
    return FacingSum() > 0 ? static_cast<double>(VisibleSum()) / FacingSum() : 1;
  }
};

// `sum` and rays `begin` to `end` of each probe.
ProbeVisibility CastFromProbes(const LightTree& tree, const RayScene& rays, int receiver, int source,
                               int begin, int end, ProbeVisibility sum) {
  const LightNode& p = tree[receiver];
  const UnitPoints points(receiver, source);
  const int probes = p.kind == FacetKind::kTriangle ? 3 : 4;
  for (int k = 0; k < probes; ++k) {
    for (int i = begin; i < end; ++i) {
      const auto [here, there] = points.At(probes * i + k);
      const RayTest test =
          TestRay(rays, {PointAroundProbe(p, k, here[0], here[1]), p.normal}, tree.PlaceOn(source, there));
      sum.facing[static_cast<size_t>(k)] += test.facing ? 1 : 0;
      sum.visible[static_cast<size_t>(k)] += test.visible ? 1 : 0;
    }
  }
  return sum;
}

// The point of an element that is nearest to another, or nearly; off its border, where form factors of
// touching polygons jump.
Eigen::Vector3d NearestPoint(const LightNode& element, const Eigen::Vector3d& to) {
  constexpr double kMargin = 0.02;
  const Eigen::Vector3d d = to - element.origin;
  Eigen::Matrix2d gram;
  gram << element.edge_u.squaredNorm(), element.edge_u.dot(element.edge_v),
      element.edge_u.dot(element.edge_v), element.edge_v.squaredNorm();
  Eigen::Vector2d uv = gram.inverse() * Eigen::Vector2d(element.edge_u.dot(d), element.edge_v.dot(d));
  uv = uv.cwiseMax(kMargin).cwiseMin(1 - kMargin);
  if (element.kind == FacetKind::kTriangle && uv.sum() > 1 - kMargin) uv *= (1 - kMargin) / uv.sum();
  return element.origin + uv[0] * element.edge_u + uv[1] * element.edge_v;
}

// Unoccluded: the mean over the receiver, from the smaller of the two, over which the kernel varies less
// (A_p F_pq = A_q F_qp); and its rms deviation over the receiver, which its probes may miss if the source is
// small and near: then with the largest value x and mean m at most sqrt(m x), or half of x - m where that is
// little.
MeanAndDeviation Unoccluded(const LightNode& p, const LightNode& q, const std::array<double, 4>& share,
                            int count, const ConvexPolygon& polygon_q) {
  MeanAndDeviation of_p = OfProbes(share, count);
  if (q.area_m2 < p.area_m2) {
    const ConvexPolygon polygon_p = MakePolygon(p.origin, p.edge_u, p.edge_v, p.kind);
    const Probes probes = ProbesOf(q);
    std::array<double, 4> back{};
    for (size_t k = 0; k < static_cast<size_t>(probes.count); ++k)
      back[k] = PointToPolygon(probes.points[k], q.normal, polygon_p);
    of_p.mean = OfProbes(back, probes.count).mean * q.area_m2 / p.area_m2;
  }
  const double above = PointToPolygon(NearestPoint(p, q.center), p.normal, polygon_q) - of_p.mean;
  if (above > 0)
    of_p.deviation = std::max(of_p.deviation, std::min(0.5 * above, std::sqrt(of_p.mean * above)));
  return of_p;
}

LinkEvaluation BetweenElements(const LightTree& tree, const RayScene& rays, int receiver, int source,
                               double tolerance) {
  const LightNode &p = tree[receiver], &q = tree[source];
  const ConvexPolygon polygon = MakePolygon(q.origin, q.edge_u, q.edge_v, q.kind);
  const Probes probes = ProbesOf(p);
  std::array<double, 4> share{};
  for (size_t k = 0; k < static_cast<size_t>(probes.count); ++k)
    share[k] = PointToPolygon(probes.points[k], p.normal, polygon);
  const MeanAndDeviation unoccluded = Unoccluded(p, q, share, probes.count, polygon);
  if (unoccluded.mean == 0) return {};
  constexpr int kMostRays = 16;  // a probe
  const int first = std::clamp(static_cast<int>(0.5 * unoccluded.mean / tolerance), 1, kMostRays);
  ProbeVisibility visibility = CastFromProbes(tree, rays, receiver, source, 0, first, {});
  const bool partial = visibility.IsPartial();
  if (partial && unoccluded.mean > tolerance)
    visibility = CastFromProbes(tree, rays, receiver, source, first, kMostRays, visibility);
  std::array<double, 4> open{};
  double weight = 0, weighted = 0;
  for (size_t k = 0; k < static_cast<size_t>(probes.count); ++k) {
    open[k] = visibility.Of(k);
    weight += share[k];
    weighted += share[k] * open[k];
  }
  const MeanAndDeviation seen = OfProbes(open, probes.count);
  const double mean = unoccluded.mean * (weight > 0 ? weighted / weight : seen.mean);
  const double deviation = std::hypot(unoccluded.deviation * seen.mean, unoccluded.mean * seen.deviation);
  return {LinkEvaluation::Verdict::kLink,
          {receiver, source, static_cast<float>(mean),
           static_cast<float>(partial && q.radius_m > p.radius_m ? -deviation : deviation)}};
}

LinkEvaluation WithClusters(const LightTree& tree, const RayScene& rays, int receiver, int source,
                            double tolerance) {
  const LightNode &p = tree[receiver], &q = tree[source];
  const Eigen::Vector3d d = q.center - p.center;
  const double reach = p.radius_m + q.radius_m;
  // What is too near to be seen as a point matters not if all light of the source could reach the receiver
  // unnoticed.
  const double r = d.norm();
  if (r < 1.5 * reach && tolerance < 1) return {LinkEvaluation::Verdict::kTooNear, {receiver, source, 0, 0}};
  const double far = std::max(r, reach);
  const double cos_p = p.IsCluster() ? 1 : std::max(0.0, p.normal.dot(d) / far);
  const double cos_q = q.IsCluster() ? 1 : std::max(0.0, -q.normal.dot(d) / far);
  const double factor = cos_p * cos_q * (q.IsCluster() ? 1 : q.area_m2 / kPi) / (far * far);
  // The same in units of mean exitance; members of clusters face the other end with half their area, on
  // average.
  const double share =
      std::min(1.0, (q.IsCluster() ? 0.5 * q.area_m2 / kPi : 1) * (p.IsCluster() ? 0.5 : 1) * factor);
  const int count = std::clamp(static_cast<int>(2 * share / tolerance), 4, 32);
  const UnitPoints points(receiver, source);
  int facing = 0, visible = 0;
  for (int i = 0; i < count; ++i) {
    const auto [here, there] = points.At(i);
    const RayTest test = TestRay(rays, tree.PlaceOn(receiver, here), tree.PlaceOn(source, there));
    facing += test.facing ? 1 : 0;
    visible += test.visible ? 1 : 0;
  }
  const double seen = facing > 0 ? static_cast<double>(visible) / facing : 1;
  // Harmonics, extent, and shadows within or between.
  constexpr double kHarmonics = 0.1;
  const double extent = 2 / std::sqrt(3.0) * reach / far;  // of 1 / r^2, rms over the spheres
  const double error =
      share * std::sqrt(seen * seen * (kHarmonics * kHarmonics + extent * extent) + seen * (1 - seen));
  return {LinkEvaluation::Verdict::kLink,
          {receiver, source, static_cast<float>(factor * seen),
           static_cast<float>(q.radius_m > p.radius_m ? -error : error)}};
}

}  // namespace

LinkEvaluation EvaluateLink(const LightTree& tree, const RayScene& rays, int receiver, int source,
                            double tolerance) {
  const LightNode &p = tree[receiver], &q = tree[source];
  if (!p.IsCluster() && (p.facet == q.facet || IsBehind(q, p))) return {};
  if (!q.IsCluster() && IsBehind(p, q)) return {};
  if (p.IsCluster() || q.IsCluster()) return WithClusters(tree, rays, receiver, source, tolerance);
  return BetweenElements(tree, rays, receiver, source, tolerance);
}

}  // namespace luxfit
