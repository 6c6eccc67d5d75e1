#include "forward/mesh/internal/plan_polygon.h"

#include <algorithm>
#include <cmath>

namespace luxfit {
namespace {

constexpr double kSameM = 1e-6;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Even-odd rule; the border belongs to either side.
bool IsInside(const PlanPolygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    inside = inside != (p.x() < x);
  }
  return inside;
}

// Returns strips across the first axis of a polygon whose edges follow the axes.
std::vector<PlanStrip> StripsOf(const PlanPolygon& polygon) {
  std::vector<double> all;
  for (const Eigen::Vector2d& p : polygon) all.push_back(p.x());
  const std::vector<double> cuts = SortedCuts(all);
  std::vector<PlanStrip> strips;
  for (size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double middle = 0.5 * (cuts[k] + cuts[k + 1]);
    std::vector<double> crossings;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.x() < middle) != (b.x() < middle)) crossings.push_back(a.y());
    }
    std::sort(crossings.begin(), crossings.end());
    PlanStrip strip{cuts[k], cuts[k + 1], {}};
    for (size_t i = 0; i + 1 < crossings.size(); i += 2)
      strip.intervals.emplace_back(crossings[i], crossings[i + 1]);
    strips.push_back(std::move(strip));
  }
  return strips;
}

}  // namespace

double SignedAreaM2(const PlanPolygon& polygon) {
  double twice = 0;
  for (size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += Cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * twice;
}

double DistanceToSegmentM(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double at = length2 > 0 ? std::clamp(ab.dot(p - a) / length2, 0.0, 1.0) : 0;
  return (p - a - at * ab).norm();
}

bool SegmentsMeet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                  const Eigen::Vector2d& d) {
  if (std::min({DistanceToSegmentM(a, c, d), DistanceToSegmentM(b, c, d), DistanceToSegmentM(c, a, b),
                DistanceToSegmentM(d, a, b)}) < kPlanGapM)
    return true;
  return (Cross(b - a, c - a) > 0) != (Cross(b - a, d - a) > 0) &&
         (Cross(d - c, a - c) > 0) != (Cross(d - c, b - c) > 0);
}

bool IsInPolygon(const PlanPolygon& polygon, const Eigen::Vector2d& p) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    if (DistanceToSegmentM(p, polygon[i], polygon[(i + 1) % polygon.size()]) <= kPlanGapM) return true;
  }
  return IsInside(polygon, p);
}

bool IsChord(const PlanPolygon& polygon, size_t i, size_t j) {
  const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
  for (size_t k = 0; k < polygon.size(); ++k) {
    const size_t next = (k + 1) % polygon.size();
    const bool shares = k == i || k == j || next == i || next == j;
    if (!shares && SegmentsMeet(a, b, polygon[k], polygon[next])) return false;
    // A corner on the chord: the shorter chord that ends in it is meant, or the chord runs along a wall.
    if (k != i && k != j && DistanceToSegmentM(polygon[k], a, b) < kPlanGapM) return false;
  }
  return IsInside(polygon, 0.5 * (a + b));
}

std::vector<PlanRectangle> MergedStrips(const std::vector<PlanStrip>& strips) {
  std::vector<PlanRectangle> done, open;
  for (const PlanStrip& strip : strips) {
    std::vector<PlanRectangle> reached;
    for (const auto& [t0, t1] : strip.intervals) {
      const auto same = std::find_if(open.begin(), open.end(), [&, t0 = t0, t1 = t1](const PlanRectangle& r) {
        return std::abs(r.t0 - t0) < kSameM && std::abs(r.t1 - t1) < kSameM &&
               std::abs(r.s1 - strip.s0) < kSameM;
      });
      if (same == open.end()) {
        reached.push_back({strip.s0, strip.s1, t0, t1});
      } else {
        reached.push_back({same->s0, strip.s1, same->t0, same->t1});
        open.erase(same);
      }
    }
    done.insert(done.end(), open.begin(), open.end());
    open = std::move(reached);
  }
  done.insert(done.end(), open.begin(), open.end());
  return done;
}

std::vector<double> SortedCuts(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const auto is_same = [](double a, double b) { return b - a < kSameM; };
  numbers.erase(std::unique(numbers.begin(), numbers.end(), is_same), numbers.end());
  return numbers;
}

std::vector<PlanPolygon> RectanglesOf(const PlanPolygon& polygon) {
  const Eigen::Vector2d along = (polygon[1] - polygon[0]).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  PlanPolygon turned;
  for (const Eigen::Vector2d& p : polygon) turned.emplace_back(along.dot(p), across.dot(p));
  for (size_t i = 0; i < turned.size(); ++i) {
    const Eigen::Vector2d edge = turned[(i + 1) % turned.size()] - turned[i];
    if (edge.cwiseAbs().minCoeff() > kSameM) return {};
  }
  PlanPolygon swapped;  // strips along the other axis
  for (const Eigen::Vector2d& p : turned) swapped.emplace_back(p.y(), p.x());
  const std::vector<PlanRectangle> first = MergedStrips(StripsOf(turned)),
                                   second = MergedStrips(StripsOf(swapped));
  std::vector<PlanPolygon> rectangles;
  if (first.size() <= second.size()) {
    for (const PlanRectangle& r : first)
      rectangles.push_back({r.s0 * along + r.t0 * across, r.s1 * along + r.t0 * across,
                            r.s1 * along + r.t1 * across, r.s0 * along + r.t1 * across});
  } else {
    for (const PlanRectangle& r : second)
      rectangles.push_back({r.t0 * along + r.s0 * across, r.t1 * along + r.s0 * across,
                            r.t1 * along + r.s1 * across, r.t0 * along + r.s1 * across});
  }
  return rectangles;
}

}  // namespace luxfit
