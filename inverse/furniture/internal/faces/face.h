// A flat face along the room's main directions, and the planes that are swept for it.
#ifndef LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_FACE_H_
#define LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_FACE_H_

#include <array>
#include <cmath>
#include <utility>

#include "inverse/furniture/internal/faces/plane_sweep.h"
#include "inverse/furniture/internal/room_axes.h"

namespace luxfit {

// A direction in which planes face: one of the room's axes and a sense.
struct Facing {
  int axis = 2;
  int sense = 1;

  bool operator==(const Facing& other) const { return axis == other.axis && sense == other.sense; }
};
constexpr std::array<Facing, 5> kFacings = {{{2, 1}, {0, -1}, {0, 1}, {1, -1}, {1, 1}}};

// Returns the axes along and across a plane that faces along `axis`.
inline std::pair<int, int> AxesOfPlane(int axis) { return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}; }

struct Face {
  Facing facing;
  Eigen::AlignedBox3d region;  // flat, along the room's axes, m
  double sigma_m = 0;          // along the normal
  double area_m2 = 0;          // of the cells that views agree on, less those where they see something else
  std::uint64_t views = 0;     // that agree

  double OffsetM() const { return region.min()[facing.axis]; }
};

// Returns the cells of the plane through a flat region.
inline SweptPlane PlaneOf(const RoomAxes& axes, const Facing& facing, const Eigen::AlignedBox3d& region,
                          double cell_m) {
  const auto [along, across] = AxesOfPlane(facing.axis);
  SweptPlane plane;
  plane.corner = axes.world_from_axes * region.min();
  plane.along = axes.world_from_axes.col(along);
  plane.across = axes.world_from_axes.col(across);
  plane.normal = facing.sense * axes.world_from_axes.col(facing.axis);
  plane.cell_m = cell_m;
  plane.columns = static_cast<int>(std::floor(region.sizes()[along] / cell_m + 1e-9));
  plane.rows = static_cast<int>(std::floor(region.sizes()[across] / cell_m + 1e-9));
  return plane;
}

// Returns a rectangle of such cells as a region.
inline Eigen::AlignedBox3d RegionOf(const Facing& facing, const Eigen::AlignedBox3d& of_plane, double cell_m,
                                    const VoteRectangle& r) {
  const auto [along, across] = AxesOfPlane(facing.axis);
  Eigen::AlignedBox3d region = of_plane;
  region.min()[along] += cell_m * r.column;
  region.min()[across] += cell_m * r.row;
  region.max()[along] = region.min()[along] + cell_m * r.columns;
  region.max()[across] = region.min()[across] + cell_m * r.rows;
  return region;
}

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FURNITURE_INTERNAL_FACES_FACE_H_
