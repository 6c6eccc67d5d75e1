#include "inverse/furniture/internal/faces/solid_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxfit {
namespace {

constexpr double kThinM = 0.04;    // a table's top
constexpr double kDeepestM = 1.2;  // a cupboard
constexpr double kRimM = 0.06;     // views look past the edges of a box
constexpr double kMostBuriedM = 0.05, kLiftM = 5e-4;
constexpr int kFewestRays = 20;     // fewer do not tell whether a box is hollow
constexpr double kFreeShare = 0.5;  // of the rays through what would be solid

// Returns the distance from a face to what lies behind its middle.
double DepthBehind(const Face& face, const RoomAxes& axes, const RayScene& mesh) {
  const Eigen::Vector3d behind = -face.facing.sense * axes.world_from_axes.col(face.facing.axis);
  const RayHit hit = mesh.Trace(axes.world_from_axes * face.region.center(), behind);
  return hit.facet < 0 ? std::numeric_limits<double>::infinity() : hit.distance;
}

Eigen::AlignedBox3d Behind(const Face& face, double depth_m) {
  Eigen::AlignedBox3d box = face.region;
  (face.facing.sense > 0 ? box.min() : box.max())[face.facing.axis] -= face.facing.sense * depth_m;
  return box;
}

// Tells whether views look through behind a face that is thin.
bool IsHollow(const Eigen::AlignedBox3d& deep, const Eigen::AlignedBox3d& thin,
              const std::vector<ViewRay>& rays) {
  const Eigen::AlignedBox3d inside(deep.min().array() + kRimM, deep.max().array() - kRimM);
  const Eigen::AlignedBox3d front(thin.min().array() - kRimM, thin.max().array() + kRimM);
  const RayCount count = CountRays(rays, inside, front);
  return count.all >= kFewestRays && count.free > kFreeShare * count.all;
}

// Tells whether views agree on a side of a box: on most of the cells that they face.
bool HasSide(const Eigen::AlignedBox3d& box, const RoomAxes& axes, const SweptViews& swept) {
  constexpr double kCellM = 0.04;
  constexpr int kFewestCells = 20;
  return std::any_of(kFacings.begin(), kFacings.end(), [&](const Facing& facing) {
    if (facing.axis == 2) return false;
    Eigen::AlignedBox3d side(box.min().array() + kRimM, box.max().array() - kRimM);
    if (side.isEmpty()) return false;
    side.min()[facing.axis] = side.max()[facing.axis] =
        (facing.sense > 0 ? box.max() : box.min())[facing.axis];
    const VoteGrid votes = Sweep(swept, PlaneOf(axes, facing, side, kCellM)).votes;
    return (votes > 0).count() >= kFewestCells && (votes > 0).count() > (votes < 0).count();
  });
}

// Lets a box that hangs reach to the floor, unless views look through below it or a place is free there.
Eigen::AlignedBox3d ToFloor(const Eigen::AlignedBox3d& box, double floor, const std::vector<ViewRay>& rays,
                            const std::vector<Eigen::Vector3d>& free_places) {
  Eigen::AlignedBox3d below = box;
  below.min().z() = floor;
  below.max().z() = box.min().z();
  const bool is_free = std::any_of(free_places.begin(), free_places.end(),
                                   [&](const Eigen::Vector3d& p) { return below.contains(p); });
  return is_free || IsHollow(below, box, rays) ? box : box.merged(below);
}

// Moves the face of a box to places that it would bury. Returns false where one lies deeper.
bool LeavesFree(const std::vector<Eigen::Vector3d>& places, const Facing& facing, Eigen::AlignedBox3d& box) {
  for (const Eigen::Vector3d& p : places) {
    if (!box.contains(p)) continue;
    double& face = facing.sense > 0 ? box.max()[facing.axis] : box.min()[facing.axis];
    if (std::abs(face - p[facing.axis]) > kMostBuriedM) return false;
    face = p[facing.axis] - facing.sense * kLiftM;
  }
  return box.sizes().minCoeff() > 0.5 * kThinM;
}

}  // namespace

std::optional<SolidBox> SolidBehind(const Face& face, const RoomAxes& axes, const RayScene& mesh,
                                    const SweptViews& swept, const std::vector<ViewRay>& rays,
                                    const std::vector<Eigen::Vector3d>& free_places) {
  const double floor = axes.bounds.min().z();
  const bool is_top = face.facing.axis == 2;
  const double depth = is_top ? face.OffsetM() - floor : DepthBehind(face, axes, mesh);
  SolidBox solid{Behind(face, std::min(kThinM, depth)), true};
  if (depth > kThinM && (is_top || depth < kDeepestM)) {
    const Eigen::AlignedBox3d deep = Behind(face, depth);
    if (is_top && HasSide(deep, axes, swept)) solid = {deep, false};
    if (!is_top && !IsHollow(deep, solid.box, rays)) solid = {ToFloor(deep, floor, rays, free_places), false};
  }
  const RayCount through = CountRays(rays, solid.box, {});
  if (through.free > kFreeShare * through.all) return std::nullopt;
  if (!LeavesFree(free_places, face.facing, solid.box)) return std::nullopt;
  return solid;
}

}  // namespace luxfit
