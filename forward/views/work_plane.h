// Where in a room illuminance is asked for: a work plane over its floor, and which points of a grid count.
//
// The floor is what faces up within 5 cm of the lowest such facet. The plane is the least rectangle over it
// that lies along an edge of it, at a height, less a margin. Points in a solid, points off
// the floor (a room that is no rectangle) and points outside a given outline do not count.
//
// Metres, world frame, z up. EN 12464-1 lets a band along the walls be left out: 0.5 m, or 15 % of the
// shorter side where that is less. Source: EN 12464-1:2021, sec. 4.4 (grid, band).
#ifndef LUXFIT_FORWARD_VIEWS_WORK_PLANE_H_
#define LUXFIT_FORWARD_VIEWS_WORK_PLANE_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "forward/light/room.h"
#include "forward/room/scene.h"
#include "forward/views/illuminance_plane.h"

namespace luxfit {

// Negative: the standard's band.
constexpr double kStandardMargin = -1;

// Nothing where no facet faces up, or the margin leaves nothing. Faces up.
std::optional<IlluminancePlane> FloorPlane(const Scene& scene, double height_m,
                                           double margin_m = kStandardMargin);

// The least axis-aligned rectangle over an outline (x, y), at z. Throws std::invalid_argument for an outline
// without an area.
IlluminancePlane PlaneOverOutline(const std::vector<Eigen::Vector2d>& outline_m, double z_m);

enum class GridPointKind : unsigned char { kCounts, kInSolid, kOutside };

// `outline_m`: (x, y) of its corners; empty: no outline. Points are held to be over the floor where
// `over_floor`.
std::vector<GridPointKind> ClassifyPoints(const Room& room, const PlaneGrid& grid,
                                          const std::vector<Eigen::Vector2d>& outline_m, bool over_floor);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_WORK_PLANE_H_
