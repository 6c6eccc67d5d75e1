// Evaluates a leaf of hierarchical radiosity alone: its direct light, free share and landing share.
#ifndef LUXFIT_FORWARD_RADIOSITY_INTERNAL_LEAF_LIGHT_H_
#define LUXFIT_FORWARD_RADIOSITY_INTERNAL_LEAF_LIGHT_H_

#include "forward/radiosity/internal/hierarchical.h"
#include "forward/radiosity/internal/light_tree.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct LeafLight {
  float direct_lx = 0, direct_error_lx = 0;  // mean and rms deviation, over the free share
  float free = 0;                            // share of the leaf that lies in no solid
  float landing = 0;                         // share of the light leaving from there that meets a front
};

// Uses four points of a parallelogram, three of a triangle, for direct light; 16 or 12 for the shares.
LeafLight EvaluateLeaf(const LightTree& tree, const Scene& scene, const RayScene& rays,
                       const DirectLight& direct_lx, int leaf);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_RADIOSITY_INTERNAL_LEAF_LIGHT_H_
