// Illuminance over a plane: a desk's height, a wall, a floor.
//
// Points are the centres of equal cells, as many along each edge as come nearest to the spacing. A spacing of
// 0 is that of EN 12464-1: p = 0.2 * 5^(log10 d), d the plane's longer side (its shorter one if they differ
// twofold and more), p at most 10 m. Direct light (occlusion tested) is the same in all channels; indirect
// light has one column a channel of the LitRoom. Metres, lx.
//
// Points inside a solid see backs alone: they are marked, and their light is that which reaches them, about
// none. Throws std::invalid_argument for edges without an area or a negative spacing. Source: EN
// 12464-1:2021, sec. 4.4, eq. 1 (grid); EN 13032-2.
#ifndef LUXFIT_FORWARD_VIEWS_ILLUMINANCE_PLANE_H_
#define LUXFIT_FORWARD_VIEWS_ILLUMINANCE_PLANE_H_

#include <Eigen/Core>
#include <vector>

#include "forward/light/room.h"
#include "forward/views/surface_view.h"

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
// With so many points along its edges, whatever its spacing. Throws for counts below 1, too.
PlaneGrid GridOf(const IlluminancePlane& plane, int count_u, int count_v);

struct PlaneOptions {
  int ray_count = 1024;  // a point, for indirect light: about 0.5 %
};

struct PlaneIlluminance {
  PlaneGrid grid;
  Eigen::VectorXd direct_lx;
  Eigen::MatrixXd indirect_lx;           // points x channels
  std::vector<unsigned char> is_inside;  // 1: in a solid
};
PlaneIlluminance ComputePlane(const Room& room, const LitRoom& lit, const IlluminancePlane& plane,
                              const PlaneOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_ILLUMINANCE_PLANE_H_
