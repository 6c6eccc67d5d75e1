// Share of each luminaire that the elements of a room see.
//
// Patch by patch a shaft to the luminaire's outline tells what is wholly seen or wholly hidden
// (forward/factors/internal/shaft.h); only elements of the other patches are probed with rays, at ProbesOf's points,
// eight rays at a time.
#ifndef LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_SIGHT_H_
#define LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_SIGHT_H_

#include <Eigen/Core>
#include <vector>

#include "forward/factors/internal/shaft.h"
#include "forward/luminaire/luminaire.h"
#include "forward/room/patches.h"
#include "forward/room/visibility.h"

namespace luxfit {

// elements x luminaires, in [0, 1]: of `order` points a side of the luminaire, those in front of the element
// that it sees; of 2 a side where those agree.
Eigen::MatrixXf ElementVisibility(const RayScene& rays, const Patches& patches,
                                  const std::vector<int>& elements, const std::vector<Luminaire>& luminaires,
                                  int order);

// What one patch sees of a luminaire, with that standing around.
Sight PatchSightOf(const Patches& patches, int patch, const Luminaire& luminaire,
                   const std::vector<Blocker>& blockers);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_DIRECT_INTERNAL_LUMINAIRE_SIGHT_H_
