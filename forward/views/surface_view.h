// Returns the luminance of a lit room along any ray.
//
//   L = rho E / pi,   E = E_direct(at the very point, occlusion tested) + E_indirect      cd/m2
//   L = Phi I(gamma) / (A cos gamma)                a luminous surface seen directly
//   L = Phi I / (pi r^2)                            a sphere
//
// E_indirect is interpolated between vertices (forward/views/internal/vertex_interpolation.h). Channels are
// columns of the reflectances: each colour has its own interreflection, and the direct light is computed once
// for all. Backs of facets, and rays that leave the scene, are black. Luminaires do not hide what is behind
// their backs.
//
// Throws std::invalid_argument unless the reflectances have one row per material of the scene.
// Source: Cohen and Wallace (1993), "Radiosity and Realistic Image Synthesis", ch. 9 (direct light per pixel,
// indirect light interpolated).
#ifndef LUXFIT_FORWARD_VIEWS_SURFACE_VIEW_H_
#define LUXFIT_FORWARD_VIEWS_SURFACE_VIEW_H_

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "forward/light/room.h"
#include "forward/luminaire/luminaire.h"

namespace luxfit {

struct VertexInterpolation;

// Holds a room with its light solved; all luminaires on, each with its flux_lm.
struct LitRoom {
  std::vector<Luminaire> luminaires;
  Eigen::MatrixXd albedo;              // materials x channels
  Eigen::MatrixXf vertex_indirect_lx;  // vertices x channels
  std::shared_ptr<const VertexInterpolation> interpolation;
};
LitRoom LightRoom(const Room& room, const std::vector<Luminaire>& luminaires, const Eigen::MatrixXd& albedo);

// Returns the room as each of the luminaires lights it alone: interreflection costs as much as for one.
std::vector<LitRoom> LightRoomByEach(const Room& room, const std::vector<Luminaire>& luminaires,
                                     const Eigen::MatrixXd& albedo);

struct ViewOptions {
  // Cells a side of a luminaire on which shadows are tested, refined where they begin. 1 is five times as
  // fast as 4 and misses what hides less than a luminaire's corners.
  int shadow_grid = 4;
};

// Returns the luminance (rays x channels) seen from `origin` along unit directions.
Eigen::MatrixXd RenderView(const Room& room, const LitRoom& lit, const Eigen::Vector3d& origin,
                           const Eigen::Matrix3Xd& directions, const ViewOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_VIEWS_SURFACE_VIEW_H_
