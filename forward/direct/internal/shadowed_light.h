// Returns the direct illuminance of a partly hidden luminaire; derivatives follow its shadows' edges.
//
//   E = int V(d) L(d) cos(theta) dOmega,    L = I / (A cos(gamma))
//
// The integral is over the directions d towards the luminous surface. Occluders do not move with the
// luminaire, so V(d) is fixed. The derivative is that of L plus what the visible part of the surface's
// outline sweeps:
//
//   dE = int V dL cos(theta) dOmega + oint V L cos(theta) d . (v x dx) / r^2     v: velocity of the outline
//
// It is exact for polygons of any kind as occluders. Rays on a grid, refined where neighbours disagree, find
// the visible shares of the surface; rays at points along the outline find those of the outline.
//
// Results are in lx per lm; metres, world frame. Points and spheres are seen whole or not at all. Their
// shadows' edges are steps whose motion has no derivative, and it is left out. Source: Reynolds transport
// theorem; Li, Aittala, Durand, Lehtinen (2018), "Differentiable Monte Carlo ray tracing through edge
// sampling"; Holzschuch and Sillion (1998), "An exhaustive error-bounding algorithm for hierarchical
// radiosity" (radiosity gradients).
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
  int outline_pieces = 16;  // for a side of a rectangle, or an eighth of a disc's rim
};

// Returns the share of the unoccluded illuminance that arrives, in [0, 1].
double VisibleShare(const RayScene& rays, const Luminaire& luminaire, const Eigen::Vector3d& p_in_world,
                    const Eigen::Vector3d& normal, const ShadowOptions& options = {});

// Returns the lx per lm that arrive.
double VisibleIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                  const Eigen::Vector3d& p_in_world, const Eigen::Vector3d& normal,
                                  const ShadowOptions& options = {});

// Returns the lx per lm that arrive, with derivatives.
DirectIlluminance ShadowedIlluminancePerLumen(const RayScene& rays, const Luminaire& luminaire,
                                              const Eigen::Vector3d& p_in_world,
                                              const Eigen::Vector3d& normal,
                                              const ShadowOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_SHADOWED_LIGHT_H_
