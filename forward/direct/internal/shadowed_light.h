// Direct illuminance of a luminaire that is partly hidden, with derivatives that follow the edges of its
// shadows.
//
//   E = int V(d) L(d) cos(theta) dOmega,    L = I / (A cos(gamma))
//
// over the directions d towards the luminous surface. What hides does not move with the luminaire, so V(d) is
// fixed and the derivative is that of L plus what the visible part of the surface's outline sweeps:
//
//   dE = int V dL cos(theta) dOmega + oint V L cos(theta) d . (v x dx) / r^2     v: velocity of the outline
//
// Exact for polygons of any kind as occluders; shares of the surface are found by rays on a grid that is
// refined where neighbours disagree, the outline by rays at points along it.
//
// lx per lm, metres, world frame. Points and spheres are seen whole or not at all: their shadows' edges are
// steps, whose motion has no derivative, and it is left out. Source: Reynolds transport theorem; Li, Aittala,
// Durand, Lehtinen (2018), "Differentiable Monte Carlo ray tracing through edge sampling"; Holzschuch and
// Sillion (1998), "An exhaustive error-bounding algorithm for hierarchical radiosity" (radiosity gradients).
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_SHADOWED_LIGHT_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_SHADOWED_LIGHT_H_

#include <Eigen/Core>

#include "forward/direct/direct_light.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct ShadowOptions {
  int grid = 4;             // cells a side before refinement
  int refinements = 4;      // halvings where corners disagree
  int outline_pieces = 16;  // a side of a rectangle, or an eighth of a disc's rim
};

// Share of the unoccluded illuminance that arrives, in [0, 1].
double VisibleShare(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                    const Eigen::Vector3d& normal, const ShadowOptions& options = {});

// lx per lm that arrive.
double VisibleIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                  const Eigen::Vector3d& p_in_world, const Eigen::Vector3d& normal,
                                  const ShadowOptions& options = {});

DirectIlluminance ShadowedIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                              const Eigen::Vector3d& p_in_world,
                                              const Eigen::Vector3d& normal,
                                              const ShadowOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_SHADOWED_LIGHT_H_
