#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "forward/mesh/internal/outline_ceiling.h"
#include "forward/mesh/internal/plan_polygon.h"
#include "forward/mesh/outline.h"

namespace luxfit {
namespace {

constexpr size_t kMostCorners = 128;
constexpr double kMostM = 1e5;  // as in meshes

using Fault = std::optional<OutlineFault>;

template <typename... Parts>
std::string Joined(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

std::string PointText(const Eigen::Vector3d& p) { return Joined("(", p.x(), ", ", p.y(), ", ", p.z(), ")"); }

bool IsFar(const Eigen::Vector2d& p) { return !(p.cwiseAbs().maxCoeff() <= kMostM); }

Fault OfCorners(const PlanPolygon& corners) {
  const auto fault = [](const std::string& message) {
    return OutlineFault{OutlinePart::kCorners, 0, message};
  };
  const size_t n = corners.size();
  if (n < 3 || n > kMostCorners)
    return fault(Joined("expected 3 to ", kMostCorners, " corners, got ", n,
                        "; name each corner of the floor once, [x, y]"));
  for (size_t i = 0; i < n; ++i) {
    if (IsFar(corners[i]))
      return fault(Joined("expected corners within 100 km of the origin, got corner ", i + 1, " at (",
                          corners[i].x(), ", ", corners[i].y(), ") m; correct it, or the unit"));
    if ((corners[(i + 1) % n] - corners[i]).norm() < kPlanGapM)
      return fault(Joined("expected walls of 1 mm and more, got none from corner ", i + 1, " to ",
                          (i + 1) % n + 1, "; name each corner once, the first not again at the end"));
  }
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % n], &c = corners[(i + 2) % n];
    const bool turns_back =
        DistanceToSegmentM(a, b, c) < kPlanGapM || DistanceToSegmentM(c, a, b) < kPlanGapM;
    if (turns_back)
      return fault(Joined("expected a way round the room, got one that turns back at corner ",
                          (i + 1) % n + 1, "; leave that corner out"));
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;  // neighbours
      if (SegmentsMeet(a, b, corners[j], corners[(j + 1) % n]))
        return fault(Joined("expected walls that do not cross, got wall ", i + 1, " (corners ", i + 1, ", ",
                            (i + 1) % n + 1, ") across wall ", j + 1, " (corners ", j + 1, ", ",
                            (j + 1) % n + 1, "); name the corners in their order round the room"));
    }
  }
  return {};
}

Fault OfHeights(const RoomOutline& outline) {
  const std::vector<double>& heights = outline.heights_m;
  if (heights.size() != 1 && heights.size() != outline.corners_m.size())
    return OutlineFault{OutlinePart::kHeights, 0,
                        Joined("expected one height, or one for each of the ", outline.corners_m.size(),
                               " corners, got ", heights.size(), "; give them in the order of the corners")};
  for (const double height : heights) {
    if (!(height >= kPlanGapM && height <= kMostM))
      return OutlineFault{OutlinePart::kHeights, 0,
                          Joined("expected heights above 0 m, got ", height,
                                 " m; give those of the ceiling above the floor")};
  }
  return {};
}

// Returns the height of a piece's plane.
double HeightAt(const std::vector<Eigen::Vector3d>& piece, const Eigen::Vector2d& p) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (size_t i = 1; i + 1 < piece.size(); ++i)
    normal += (piece[i] - piece[0]).cross(piece[i + 1] - piece[0]);
  return piece[0].z() - normal.head<2>().dot(p - piece[0].head<2>()) / normal.z();
}

class RoomInside {
 public:
  explicit RoomInside(const RoomOutline& outline) : corners_(outline.corners_m) {
    std::vector<Eigen::Vector3d> top;
    for (size_t i = 0; i < corners_.size(); ++i)
      top.emplace_back(corners_[i].x(), corners_[i].y(),
                       outline.heights_m[outline.heights_m.size() == 1 ? 0 : i]);
    if (SignedAreaM2(corners_) < 0) std::reverse(top.begin(), top.end());
    ceiling_ = PlanePieces(top);
  }

  bool Contains(const RoomBox& box) const {
    const std::array<Eigen::Vector2d, 4> plan = PlanOf(box);
    const PlanPolygon footprint(plan.begin(), plan.end());
    for (const Eigen::Vector2d& p : plan) {
      if (!IsInPolygon(corners_, p) || box.min_m.z() < -kPlanGapM || IsAboveCeiling(p, box.max_m.z()))
        return false;
    }
    // Corners of the room that stand in the box: it spans a recess.
    return std::none_of(corners_.begin(), corners_.end(), [&](const Eigen::Vector2d& p) {
      for (size_t k = 0; k < 4; ++k) {
        const Eigen::Vector2d along = (plan[(k + 1) % 4] - plan[k]).normalized(), to = p - plan[k];
        if (along.x() * to.y() - along.y() * to.x() < kPlanGapM) return false;
      }
      return true;
    });
  }

 private:
  bool IsAboveCeiling(const Eigen::Vector2d& p, double z_m) const {
    return std::none_of(ceiling_.begin(), ceiling_.end(), [&](const std::vector<Eigen::Vector3d>& piece) {
      PlanPolygon plan;
      for (const Eigen::Vector3d& corner : piece) plan.emplace_back(corner.head<2>());
      return IsInPolygon(plan, p) && z_m <= HeightAt(piece, p) + kPlanGapM;
    });
  }

  PlanPolygon corners_;
  std::vector<std::vector<Eigen::Vector3d>> ceiling_;
};

Fault OfBoxes(const RoomOutline& outline) {
  const RoomInside room(outline);
  for (size_t i = 0; i < outline.boxes.size(); ++i) {
    const RoomBox& box = outline.boxes[i];
    const auto fault = [&](const std::string& message) {
      return OutlineFault{OutlinePart::kBox, static_cast<int>(i), message};
    };
    if (!((box.max_m - box.min_m).minCoeff() >= kPlanGapM))
      return fault(Joined("expected min below max along x, y and z, got ", PointText(box.min_m), " to ",
                          PointText(box.max_m), " m; exchange them"));
    if (!std::isfinite(box.turn_rad) || !room.Contains(box))
      return fault(Joined(
          "expected a box inside the room, got ", PointText(box.min_m), " to ", PointText(box.max_m),
          " m, which reaches beyond a wall, the floor (z = 0) or the ceiling; correct it, or the outline"));
  }
  return {};
}

Fault OfRectangles(const RoomOutline& outline) {
  const int walls = static_cast<int>(outline.corners_m.size());
  for (size_t i = 0; i < outline.rectangles.size(); ++i) {
    const WallRectangle& r = outline.rectangles[i];
    const auto fault = [&](const std::string& message) {
      return OutlineFault{OutlinePart::kRectangle, static_cast<int>(i), message};
    };
    if (r.wall < 0 || r.wall >= walls)
      return fault(Joined("expected a wall from 1 to ", walls, ", got ", r.wall + 1,
                          "; wall 1 runs from the first corner to the second"));
    const auto first = static_cast<size_t>(r.wall), second = (first + 1) % outline.corners_m.size();
    const double length = (outline.corners_m[second] - outline.corners_m[first]).norm();
    const auto height = [&](double s) {
      const std::vector<double>& h = outline.heights_m;
      return h.size() == 1 ? h[0] : h[first] + (h[second] - h[first]) * s / length;
    };
    if (!(r.from_m >= -kPlanGapM && r.to_m - r.from_m >= kPlanGapM && r.to_m <= length + kPlanGapM))
      return fault(Joined("expected from and to on wall ", r.wall + 1, ", which is ", length, " m long, got ",
                          r.from_m, " to ", r.to_m, " m; they count from the wall's first corner"));
    const double top = std::min(height(r.from_m), height(r.to_m));
    if (!(r.low_m >= -kPlanGapM && r.high_m - r.low_m >= kPlanGapM && r.high_m <= top + kPlanGapM))
      return fault(Joined("expected low and high on wall ", r.wall + 1, ", which is ", top,
                          " m high there, got ", r.low_m, " to ", r.high_m, " m; they count from the floor"));
    for (size_t k = 0; k < i; ++k) {
      const WallRectangle& o = outline.rectangles[k];
      const double along = std::min(r.to_m, o.to_m) - std::max(r.from_m, o.from_m);
      const double up = std::min(r.high_m, o.high_m) - std::max(r.low_m, o.low_m);
      if (o.wall == r.wall && along > kPlanGapM && up > kPlanGapM)
        return fault(Joined("expected openings that do not overlap, got \"", o.name, "\" and \"", r.name,
                            "\" on one place of wall ", r.wall + 1, "; cut one of them"));
    }
  }
  return {};
}

}  // namespace

std::optional<OutlineFault> FindFault(const RoomOutline& outline) {
  if (Fault fault = OfCorners(outline.corners_m)) return fault;
  if (Fault fault = OfHeights(outline)) return fault;
  if (Fault fault = OfBoxes(outline)) return fault;
  return OfRectangles(outline);
}

}  // namespace luxfit
