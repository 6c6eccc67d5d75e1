// Returns the share of each luminaire that the elements of a room see.
//
// For each patch a shaft to the luminaire's outline finds the luminaires that are wholly seen or wholly
// hidden (forward/factors/internal/shaft.h). Only elements of the other patches are probed with rays, at the
// points of ShadowProbesOf, eight rays at a time.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_SIGHT_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_SIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/factors/internal/shaft.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/patches.h"
#include "forward/room/visibility.h"

namespace luxfit {

// Returns the centres of the 16 like parts of an element. Few edges of shadows cross it between them.
// An element that a solid cuts has its quarter points (ProbesOf): more would lie in the solid.
std::vector<Eigen::Vector3d> ShadowProbesOf(const Element& element, bool triangle);

// Returns elements x luminaires, in [0, 1]: the share of the luminaire's points in front of the element
// (`order` a side) that the element sees. Where 2 points a side are all seen or all hidden, no more are
// tested.
Eigen::MatrixXf ElementVisibility(const RayScene& rays, const Patches& patches,
                                  const std::vector<int>& elements, const std::vector<Luminaire>& luminaires,
                                  int order);

// Returns how one patch sees a luminaire among the blockers.
Sight PatchSightOf(const Patches& patches, int patch, const Luminaire& luminaire,
                   const std::vector<Blocker>& blockers);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_SIGHT_H_
