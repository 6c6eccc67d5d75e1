// Estimates the shares of rays between surfaces that are lost, without form factors.
//
// Four points of every facet, or of 4096 facets evenly over larger scenes, send 64 rays each over their front's
// hemisphere, by cosine; facets count by area. Points whose rays meet no front lie outside and do not count.
// With a closed room both shares are 0. The estimate serves WithRayShares (forward/mesh/mesh_check.h), where
// form factors would take minutes.
#ifndef LUXFIT_FORWARD_MESH_RAY_SHARES_H_
#define LUXFIT_FORWARD_MESH_RAY_SHARES_H_

#include "forward/mesh/mesh_check.h"
#include "forward/room/scene.h"

namespace luxfit {

RayShares EstimateRayShares(const Scene& scene);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_RAY_SHARES_H_
