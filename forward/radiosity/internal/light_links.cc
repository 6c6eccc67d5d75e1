#include "forward/radiosity/internal/light_links.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "forward/factors/internal/polygon_factor.h"
#include "forward/room/internal/sampling.h"

namespace luxfit {
namespace {

constexpr double kPlaneTolerance = 1e-9;  // m

// Tells whether all of `node` lies behind the plane of `element`.
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

// Generates points of the unit cube, different for every link: an additive sequence (x^4 = x + 1) with a
// hashed start.
class UnitPoints {
 public:
  UnitPoints(int receiver, int source) {
    uint64_t hash = Mix(Mix(static_cast<uint64_t>(receiver)) + static_cast<uint64_t>(source));
    for (double& x : start_) x = UnitFrom(hash = Mix(hash));
  }
  // Returns the point of the receiver's end and that of the source's end.
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

// Holds the visibility of the source from around each probe of the receiver.
struct ProbeVisibility {
  std::array<int, 4> facing{}, visible{};

  int FacingSum() const { return facing[0] + facing[1] + facing[2] + facing[3]; }
  int VisibleSum() const { return visible[0] + visible[1] + visible[2] + visible[3]; }
  bool IsPartial() const { return VisibleSum() > 0 && VisibleSum() < FacingSum(); }
  double Of(size_t k) const { return facing[k] > 0 ? static_cast<double>(visible[k]) / facing[k] : Mean(); }
  double Mean() const { return FacingSum() > 0 ? static_cast<double>(VisibleSum()) / FacingSum() : 1; }
};

// Adds rays `begin` to `end` of each probe to `sum`.
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

// Returns (u, v) of the point of the element's plane below `point`: origin + u edge_u + v edge_v.
Eigen::Vector2d PlaceOf(const LightNode& element, const Eigen::Vector3d& point) {
  const Eigen::Vector3d d = point - element.origin;
  Eigen::Matrix2d gram;
  gram << element.edge_u.squaredNorm(), element.edge_u.dot(element.edge_v),
      element.edge_u.dot(element.edge_v), element.edge_v.squaredNorm();
  return gram.inverse() * Eigen::Vector2d(element.edge_u.dot(d), element.edge_v.dot(d));
}

// Returns the point of an element that is nearest to another, or nearly. It lies off the border, where form
// factors of touching polygons jump.
Eigen::Vector3d NearestPoint(const LightNode& element, const Eigen::Vector3d& to) {
  constexpr double kMargin = 0.02;
  Eigen::Vector2d uv = PlaceOf(element, to);
  uv = uv.cwiseMax(kMargin).cwiseMin(1 - kMargin);
  if (element.kind == FacetKind::kTriangle && uv.sum() > 1 - kMargin) uv *= (1 - kMargin) / uv.sum();
  return element.origin + uv[0] * element.edge_u + uv[1] * element.edge_v;
}

// Returns the rms deviation over an element, in units of the mean, of light that only its part before
// another's plane receives, evenly: an element may run on below a solid.
double CutOffBy(const ConvexPolygon& polygon, const LightNode& plane) {
  bool above = false, below = false;
  for (int i = 0; i < polygon.count; ++i) {
    const double height = plane.normal.dot(polygon[i] - plane.center);
    above = above || height > kPlaneTolerance;
    below = below || height < -kPlaneTolerance;
  }
  if (!above || !below) return 0;
  const double before_m2 = InFrontOf(polygon, plane.center, plane.normal).AreaM2();
  return before_m2 > 0 ? std::sqrt(std::max(0.0, polygon.AreaM2() / before_m2 - 1)) : 0;
}

// Holds the unoccluded factor: its mean over the receiver and its rms deviation there. The mean is taken from
// the smaller of the two, over which the kernel varies less (A_p F_pq = A_q F_qp). Where only a part of one
// is before the other, which points may miss, the mean is the closed form. Probes of the receiver may miss
// the deviation if the source is small and near. With the largest value x and mean m it is then at most
// sqrt(m x), or half of x - m where that is little.
struct UnoccludedFactor {
  double mean = 0, deviation = 0;
  double over_source = 0;  // rms deviation over the source, where only a part of it is before the receiver
};
UnoccludedFactor Unoccluded(const LightNode& p, const LightNode& q, const std::array<double, 4>& share,
                            int count, const ConvexPolygon& polygon_q) {
  const MeanAndDeviation of_p = OfProbes(share, count);
  UnoccludedFactor factor{of_p.mean, of_p.deviation, 0};
  const ConvexPolygon polygon_p = MakePolygon(p.origin, p.edge_u, p.edge_v, p.kind);
  const double cut_p = CutOffBy(polygon_p, q), cut_q = CutOffBy(polygon_q, p);
  if (cut_p > 0 || cut_q > 0) {
    factor.mean = PolygonToPolygon(polygon_p, polygon_q);
  } else if (q.area_m2 < p.area_m2) {
    const Probes probes = ProbesOf(q);
    std::array<double, 4> back{};
    for (size_t k = 0; k < static_cast<size_t>(probes.count); ++k)
      back[k] = PointToPolygon(probes.points[k], q.normal, polygon_p);
    factor.mean = OfProbes(back, probes.count).mean * q.area_m2 / p.area_m2;
  }
  const double above = PointToPolygon(NearestPoint(p, q.center), p.normal, polygon_q) - factor.mean;
  if (above > 0)
    factor.deviation = std::max(factor.deviation, std::min(0.5 * above, std::sqrt(factor.mean * above)));
  factor.deviation = std::max(factor.deviation, factor.mean * cut_p);
  factor.over_source = factor.mean * cut_q;
  return factor;
}

LinkEvaluation BetweenElements(const LightTree& tree, const RayScene& rays, int receiver, int source,
                               double tolerance) {
  const LightNode &p = tree[receiver], &q = tree[source];
  const ConvexPolygon polygon = MakePolygon(q.origin, q.edge_u, q.edge_v, q.kind);
  const Probes probes = ProbesOf(p);
  std::array<double, 4> share{};
  for (size_t k = 0; k < static_cast<size_t>(probes.count); ++k)
    share[k] = PointToPolygon(probes.points[k], p.normal, polygon);
  const UnoccludedFactor unoccluded = Unoccluded(p, q, share, probes.count, polygon);
  if (unoccluded.mean == 0) return {};
  constexpr int kMostRays = 16;  // per probe
  const int first = std::clamp(static_cast<int>(0.5 * unoccluded.mean / tolerance), 1, kMostRays);
  ProbeVisibility judged = CastFromProbes(tree, rays, receiver, source, 0, first, {});
  const bool partial = judged.IsPartial();
  const int count = partial && unoccluded.mean > tolerance ? kMostRays : first;
  judged = CastFromProbes(tree, rays, receiver, source, first, count, judged);
  // Other rays measure than those that decide whether to cut. A source of which the deciding rays happen to
  // see all would stay whole, and count as seen whole.
  const ProbeVisibility measured = CastFromProbes(tree, rays, receiver, source, count, 2 * count, {});
  std::array<double, 4> open{};
  double weight = 0, weighted = 0;
  for (size_t k = 0; k < static_cast<size_t>(probes.count); ++k) {
    open[k] = judged.Of(k);
    weight += share[k];
    weighted += share[k] * measured.Of(k);
  }
  const MeanAndDeviation seen = OfProbes(open, probes.count);
  const double mean = unoccluded.mean * (weight > 0 ? weighted / weight : measured.Mean());
  const double deviation = std::hypot(unoccluded.deviation * seen.mean, unoccluded.mean * seen.deviation);
  const double shadow = std::hypot(unoccluded.mean * std::sqrt(std::max(0.0, seen.mean * (1 - seen.mean))),
                                   unoccluded.over_source * seen.mean);
  return {LinkEvaluation::Verdict::kLink,
          {receiver, source, static_cast<float>(mean),
           static_cast<float>(partial && q.radius_m > p.radius_m ? -deviation : deviation),
           static_cast<float>(shadow),
           static_cast<float>(partial || count == kMostRays ? 0 : unoccluded.mean / (probes.count * count))}};
}

// Returns the share of the facing pairs of points of both ends, `begin` to `end` of the link's sequence, that
// see each other; 1 if none face.
double SeenShare(const LightTree& tree, const RayScene& rays, int receiver, int source, int begin, int end) {
  const UnitPoints points(receiver, source);
  int facing = 0, visible = 0;
  for (int i = begin; i < end; ++i) {
    const auto [here, there] = points.At(i);
    const RayTest test = TestRay(rays, tree.PlaceOn(receiver, here), tree.PlaceOn(source, there));
    facing += test.facing ? 1 : 0;
    visible += test.visible ? 1 : 0;
  }
  return facing > 0 ? static_cast<double>(visible) / facing : 1;
}

// Tells whether a node holds a point of a facet.
bool Holds(const LightTree& tree, int index, int facet, const Eigen::Vector3d& point) {
  const LightNode& node = tree[index];
  if (node.IsCluster()) {
    const int member = tree.MemberOf(facet);
    return member >= node.first_member && member < node.end_member;
  }
  if (node.facet != facet) return false;
  const Eigen::Vector2d uv = PlaceOf(node, point);
  return uv.minCoeff() >= 0 && (node.kind == FacetKind::kTriangle ? uv.sum() : uv.maxCoeff()) <= 1;
}

// Returns the share of the receiver's rays, by the cosine, that meet the front of the source.
double MeetingShare(const LightTree& tree, const RayScene& rays, int receiver, int source, int count) {
  const UnitPoints points(receiver, source);
  int meeting = 0;
  for (int i = 0; i < count; ++i) {
    const auto [here, there] = points.At(i);
    const LightTree::Place from = tree.PlaceOn(receiver, here);
    const Eigen::Vector3d direction = FrameOf(from.normal) * LiftedFromDisc(there[0], there[1]);
    const Eigen::Vector3d start = LiftedOff(from.point, from.normal);
    const RayHit hit = rays.Trace(start, direction);
    if (hit.facet < 0 || !hit.front) continue;
    meeting += Holds(tree, source, hit.facet, start + hit.distance * direction) ? 1 : 0;
  }
  return static_cast<double>(meeting) / count;
}

// Links nodes that are near each other: members of both lie anywhere in their spheres, and face anywhere.
LinkEvaluation BetweenNear(const LightTree& tree, const RayScene& rays, int receiver, int source,
                           double tolerance) {
  const LightNode &p = tree[receiver], &q = tree[source];
  // The mean of 1 / r^2 between points of one sphere is 9 / 4 over its radius squared.
  const double reach = p.radius_m + q.radius_m;
  const double share =
      std::min(1.0, q.area_m2 / (4 * M_PI) / ((q.center - p.center).squaredNorm() + reach * reach / 9));
  if (share > tolerance) return {LinkEvaluation::Verdict::kTooNear, {receiver, source, 0, 0, 0, 0}};
  constexpr int kRays = 8;
  const double factor = MeetingShare(tree, rays, receiver, source, kRays);
  return {LinkEvaluation::Verdict::kLink,
          {receiver, source, static_cast<float>(factor),
           static_cast<float>(q.radius_m > p.radius_m ? -share : share), 0, 0}};
}

LinkEvaluation BetweenDistant(const LightTree& tree, const RayScene& rays, int receiver, int source,
                              double tolerance) {
  const LightNode &p = tree[receiver], &q = tree[source];
  const Eigen::Vector3d d = q.center - p.center;
  const double r = d.norm();
  const double cos_p = p.IsCluster() ? 1 : std::max(0.0, p.normal.dot(d) / r);
  const double cos_q = q.IsCluster() ? 1 : std::max(0.0, -q.normal.dot(d) / r);
  const double factor = cos_p * cos_q * (q.IsCluster() ? 1 : q.area_m2 / M_PI) / (r * r);
  // `share` is the factor in units of mean exitance: members of clusters face the other end with half their
  // area, on average.
  const double share =
      std::min(1.0, (q.IsCluster() ? 0.5 * q.area_m2 / M_PI : 1) * (p.IsCluster() ? 0.5 : 1) * factor);
  constexpr int kMostRays = 32;
  const int count = std::clamp(static_cast<int>(2 * share / tolerance), 4, kMostRays);
  // Some rays decide whether to cut, others measure: see BetweenElements.
  const double judged = SeenShare(tree, rays, receiver, source, 0, count);
  const double measured = SeenShare(tree, rays, receiver, source, count, 2 * count);
  const bool agreed = judged == 0 || judged == 1;
  // The error is that of harmonics, extent, and shadows within or between.
  constexpr double kHarmonics = 0.1;
  // Rms deviation of 1 / r^2 over balls evenly filled.
  const double extent = 2 / std::sqrt(5.0) * std::hypot(p.radius_m, q.radius_m) / r;
  const double error = share * std::sqrt(judged * judged * (kHarmonics * kHarmonics + extent * extent) +
                                         judged * (1 - judged));
  return {LinkEvaluation::Verdict::kLink,
          {receiver, source, static_cast<float>(factor * measured),
           static_cast<float>(q.radius_m > p.radius_m ? -error : error), 0,
           static_cast<float>(agreed && count < kMostRays ? share / count : 0)}};
}

}  // namespace

bool AreNear(const LightNode& p, const LightNode& q) {
  constexpr double kNear = 1.5;
  return (p.IsCluster() || q.IsCluster()) && (q.center - p.center).norm() < kNear * (p.radius_m + q.radius_m);
}

LinkEvaluation EvaluateLink(const LightTree& tree, const RayScene& rays, int receiver, int source,
                            double tolerance) {
  const LightNode &p = tree[receiver], &q = tree[source];
  if (!p.IsCluster() && (p.facet == q.facet || IsBehind(q, p))) return {};
  if (!q.IsCluster() && IsBehind(p, q)) return {};
  if (AreNear(p, q)) return BetweenNear(tree, rays, receiver, source, tolerance);
  if (p.IsCluster() || q.IsCluster()) return BetweenDistant(tree, rays, receiver, source, tolerance);
  return BetweenElements(tree, rays, receiver, source, tolerance);
}

}  // namespace luxfit
