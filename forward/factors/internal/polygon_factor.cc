#include "forward/factors/internal/polygon_factor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "forward/room/internal/polar_angle.h"

namespace luxfit {
namespace {

using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
using Gauss = boost::math::quadrature::gauss<double, 7>;

constexpr double kPlaneTolerance = 1e-9;  // m: what lies this near a plane lies in it

// Integral of ln(sqrt(t^2 + h^2)) over t, from 0.
double LogDistanceIntegral(double t, double h) {
  const double r2 = t * t + h * h;
  if (r2 < 1e-300) return 0;
  return 0.5 * t * std::log(r2) - t + (h > 0 ? h * std::atan(t / h) : 0);
}

// Integral of ln r from a point along the edge from a to b, per metre of the edge's length.
double LogDistanceToEdge(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& direction,
                         double length) {
  const Eigen::Vector3d d = p - a;
  const double foot = d.dot(direction);
  // Not sqrt(d^2 - foot^2): near the edge's line that is noise of 1e-8, which no quadrature can integrate.
  const double h = (d - foot * direction).norm();
  return LogDistanceIntegral(length - foot, h) - LogDistanceIntegral(-foot, h);
}

// Integral of f over [a, b] by halving where the 15-point Kronrod rule and the 7-point Gauss rule in it differ
// by more than `tolerance`. Not Boost's own integrate(): its tolerance is relative, and these integrals cancel.
template <typename Function>
double AdaptiveIntegral(const Function& f, double a, double b, double tolerance, int depth) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  // From the centre outwards on [-1, 1]; every other node is one of Gauss's.
  const auto &nodes = Kronrod::abscissa(), &weights = Kronrod::weights();
  const auto& gauss_weights = Gauss::weights();
  const double center = f(middle);
  double kronrod = weights[0] * center, gauss = gauss_weights[0] * center;
  for (size_t k = nodes.size() - 1; k > 0; --k) {
    const double sum = f(middle - half * nodes[k]) + f(middle + half * nodes[k]);
    kronrod += weights[k] * sum;
    if (k % 2 == 0) gauss += gauss_weights[k / 2] * sum;
  }
  if (depth == 0 || std::abs(kronrod - gauss) * half < tolerance) return kronrod * half;
  return AdaptiveIntegral(f, a, middle, 0.5 * tolerance, depth - 1) +
         AdaptiveIntegral(f, middle, b, 0.5 * tolerance, depth - 1);
}

double PlaneDistance(const Eigen::Vector3d& v, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  return normal.dot(v - p);
}

// Calls use(i, t) for every corner of the part of a polygon in front of the plane through p: the point t of
// the way from its corner i to the next, t = 0 being that corner itself. NaN counts as in front, so that it
// is not lost. Sutherland and Hodgman (1974).
template <typename Use>
void ForEachCornerInFront(const ConvexPolygon& polygon, const Eigen::Vector3d& p,
                          const Eigen::Vector3d& normal, const Use& use) {
  for (int i = 0; i < polygon.count; ++i) {
    const double ha = PlaneDistance(polygon[i], p, normal);
    const double hb = PlaneDistance(polygon[(i + 1) % polygon.count], p, normal);
    if (!(ha < -kPlaneTolerance)) use(i, 0.0);
    if (std::min(ha, hb) < -kPlaneTolerance && std::max(ha, hb) > kPlaneTolerance) use(i, ha / (ha - hb));
  }
}

Eigen::Vector3d AreaVector(const ConvexPolygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 2; i < polygon.count; ++i)
    sum += 0.5 * (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum;
}

// oint oint ln r dr . dr
double DoubleContour(const ConvexPolygon& from, const ConvexPolygon& to, double tolerance) {
  double sum = 0;
  for (int i = 0; i < from.count; ++i) {
    const Eigen::Vector3d &a = from[i], edge = from[(i + 1) % from.count] - a;
    const double length = edge.norm();
    if (length < kPlaneTolerance) continue;
    const Eigen::Vector3d direction = edge / length;
    for (int k = 0; k < to.count; ++k) {
      const Eigen::Vector3d &c = to[k], other = to[(k + 1) % to.count] - c;
      const double other_length = other.norm();
      if (other_length < kPlaneTolerance) continue;
      const Eigen::Vector3d other_direction = other / other_length;
      const double cosine = direction.dot(other_direction);
      if (std::abs(cosine) < 1e-12) continue;
      const auto inner = [&](double s) {
        return LogDistanceToEdge(a + s * direction, c, other_direction, other_length);
      };
      sum += cosine * AdaptiveIntegral(inner, 0, length, tolerance / std::abs(cosine), 24);
    }
  }
  return sum;
}

}  // namespace

ConvexPolygon MakePolygon(const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_u,
                          const Eigen::Vector3d& edge_v, FacetKind kind) {
  ConvexPolygon polygon;
  polygon.Add(origin);
  polygon.Add(origin + edge_u);
  if (kind == FacetKind::kParallelogram) polygon.Add(origin + edge_u + edge_v);
  polygon.Add(origin + edge_v);
  return polygon;
}

ConvexPolygon InFrontOf(const ConvexPolygon& polygon, const Eigen::Vector3d& p,
                        const Eigen::Vector3d& normal) {
  ConvexPolygon front;
  ForEachCornerInFront(polygon, p, normal, [&](int i, double t) {
    front.Add(polygon[i] + t * (polygon[(i + 1) % polygon.count] - polygon[i]));
  });
  return front;
}

double PointToPolygon(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, const ConvexPolygon& polygon) {
  const ConvexPolygon front = InFrontOf(polygon, p, normal);
  if (front.count < 3) return 0;
  double sum = 0;
  Eigen::Vector3d a = front[front.count - 1] - p;
  for (int i = 0; i < front.count; ++i) {
    const Eigen::Vector3d b = front[i] - p;
    const Eigen::Vector3d cross = a.cross(b);
    const double sine = cross.norm();
    // In line with an edge: it adds nothing, beyond it or within it (where the angle is pi, the normal gives
    // 0).
    if (!(sine <= 1e-300)) sum += PolarAngle(sine, a.dot(b)) * normal.dot(cross) / sine;
    a = b;
  }
  // Counter-clockwise from its front means clockwise for the point that it faces.
  return std::max(-sum / (2 * M_PI), 0.0);
}

PolygonGradient PointToPolygonGradient(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                       const ConvexPolygon& polygon) {
  struct Corner {
    int edge;
    double t;
    Eigen::Vector3d at, gradient;
  };
  std::array<Corner, 9> front;
  size_t count = 0;
  ForEachCornerInFront(polygon, p, normal, [&](int i, double t) {
    const Eigen::Vector3d at = polygon[i] + t * (polygon[(i + 1) % polygon.count] - polygon[i]);
    front[count++] = {i, t, at - p, Eigen::Vector3d::Zero()};
  });
  PolygonGradient result;
  result.d_vertex.fill(Eigen::Vector3d::Zero());
  if (count < 3) return result;
  for (size_t i = 0; i < count; ++i) {
    // One edge adds f = angle (n . w) / |w|, w = a x b.
    Corner &from = front[i], &to = front[i + 1 == count ? 0 : i + 1];
    const Eigen::Vector3d &a = from.at, &b = to.at, w = a.cross(b);
    const double s = w.norm(), q = a.dot(b), r4 = a.squaredNorm() * b.squaredNorm();
    if (s < 1e-100) continue;  // in line with the edge; s^3 is still a number
    const double angle = PolarAngle(s, q), height = normal.dot(w);
    result.factor += angle * height / s;
    const double bend = (q / r4 - angle / s) / (s * s);  // of angle / s with s, over s
    from.gradient += height * (bend * b.cross(w) - b / r4) + angle / s * b.cross(normal);
    to.gradient += height * (bend * w.cross(a) - a / r4) + angle / s * normal.cross(a);
  }
  // The sign as in PointToPolygon; a point behind the polygon sees nothing of it.
  const double scale = result.factor > 0 ? 0 : -1 / (2 * M_PI);
  result.factor *= scale;
  // A corner cut off by the receiver's plane stays t of the way along its edge: sliding along it, it sweeps
  // what lies in that plane, which brings nothing.
  for (size_t i = 0; i < count; ++i) {
    const Corner& corner = front[i];
    const size_t edge = static_cast<size_t>(corner.edge),
                 next = (edge + 1) % static_cast<size_t>(polygon.count);
    result.d_vertex[edge] += scale * (1 - corner.t) * corner.gradient;
    result.d_vertex[next] += scale * corner.t * corner.gradient;
  }
  return result;
}

double PolygonToPolygon(const ConvexPolygon& from, const ConvexPolygon& to) {
  const Eigen::Vector3d area_from = AreaVector(from), area_to = AreaVector(to);
  const double area = area_from.norm();
  const ConvexPolygon seen = InFrontOf(to, from[0], area_from / area);
  if (seen.count < 3) return 0;
  const ConvexPolygon seeing = InFrontOf(from, to[0], area_to.normalized());
  if (seeing.count < 3) return 0;
  const double sum = DoubleContour(seeing, seen, 1e-9 * std::sqrt(area * area_to.norm()));
  return std::max(0.0, sum / (2 * M_PI * area));
}

}  // namespace luxfit
