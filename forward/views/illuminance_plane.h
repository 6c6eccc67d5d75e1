// Lays the standards' grid over planes, finds work planes, and gives the statistics of their light.
//
//   p = 0.2 * 5^(log10 d)                                                         grid spacing and side d, m
//   E_avg = mean E_i,   E_min = min E_i,   U0 = E_min / E_avg,   Ud = E_min / E_max                       lx
//   Var(E_avg) = |mean s_i|^2 + (f E_avg)^2,   Var(E_min) = |s_min|^2 + (f E_min)^2
//   Var(U0) / U0^2 = |s_min / E_min - mean s_i / E_avg|^2 + f^2 (1 + 1/n)
//
// Points are the centres of equal cells, as many along each edge as come nearest to the spacing. A spacing of
// 0 is that of EN 12464-1: p, at most 10 m. Here d is the plane's longer side (its shorter one if they differ
// twofold and more).
//
// The floor is what faces up within 5 cm of the lowest such facet. The work plane is the least rectangle over
// it that lies along an edge of it, at a height, less a margin. Points in a solid, points off the floor (a
// room that is no rectangle) and points outside a given outline do not count. EN 12464-1 lets a band along
// the walls be left out: 0.5 m, or 15 % of the shorter side where that is less.
//
// s_i is the row of point i in a factor S of the points' covariance, Cov(E) = S S^T. The relative model error
// f is common to all points in E_avg and each point's own in U0. The propagation is of first order: the point
// of least light stays the same. Statistics of no point, or of points without light, are not defined:
// `points` is 0, or U0 is 0.
//
// Units are m and lx; world frame, z up. Throws std::invalid_argument for edges without an area, a negative
// spacing, and statistics of sizes that differ.
// Source: EN 12464-1:2021, sec. 3 and 4.4, eq. 1 (grid, band); EN 13032-2; EN 12665:2018 (uniformity); JCGM
// 100:2008, sec. 5.2 (propagation).
#ifndef LUXFIT_FORWARD_VIEWS_ILLUMINANCE_PLANE_H_
#define LUXFIT_FORWARD_VIEWS_ILLUMINANCE_PLANE_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "forward/light/room.h"
#include "forward/room/scene.h"

namespace luxfit {

struct IlluminancePlane {
  Eigen::Vector3d origin;
  Eigen::Vector3d edge_u, edge_v;  // the meters face edge_u x edge_v
  double spacing_m = 0;
};

struct PlaneGrid {
  int count_u = 0, count_v = 0;
  Eigen::Vector3d normal;
  Eigen::Matrix3Xd points;  // u fastest
};
PlaneGrid GridOf(const IlluminancePlane& plane);
// Returns the grid with so many points along its edges, whatever its spacing. Throws for counts below 1, too.
PlaneGrid GridOf(const IlluminancePlane& plane, int count_u, int count_v);

// A negative margin stands for the standard's band.
constexpr double kStandardMargin = -1;

// Returns the work plane over the floor, which faces up. Returns nothing where no facet faces up, or the
// margin leaves nothing.
std::optional<IlluminancePlane> FloorPlane(const Scene& scene, double height_m,
                                           double margin_m = kStandardMargin);

// Returns the least axis-aligned rectangle over an outline (x, y), at z. Throws std::invalid_argument for an
// outline without an area.
IlluminancePlane PlaneOverOutline(const std::vector<Eigen::Vector2d>& outline_m, double z_m);

enum class GridPointKind : unsigned char { kCounts, kInSolid, kOutside };

// Classifies the points. `outline_m` holds (x, y) of its corners; empty: no outline. With `over_floor`,
// points off the floor do not count.
std::vector<GridPointKind> ClassifyPoints(const Room& room, const PlaneGrid& grid,
                                          const std::vector<Eigen::Vector2d>& outline_m, bool over_floor);

struct PlaneStatistics {
  int points = 0;
  double average_lx = 0, least_lx = 0, largest_lx = 0;
  double uniformity = 0;  // U0
  double diversity = 0;   // Ud
  // One standard deviation; 0 where no factor was given.
  double average_sigma_lx = 0, least_sigma_lx = 0, uniformity_sigma = 0;
};

// Returns the statistics of the points that belong to the area: those with `counts[i]`. `factor` is points x
// any, or empty.
PlaneStatistics StatisticsOf(const Eigen::VectorXd& illuminance_lx, const std::vector<bool>& counts,
                             const Eigen::MatrixXd& factor = {}, double relative_model_error = 0);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_ILLUMINANCE_PLANE_H_
