// Visible shares of pairs that may be partly hidden, by shadow rays.
//
//   share = sum of k V / sum of k,    k = cos cos' / r^4 between random points of element and patch
//
// One low-discrepancy ray a pair first (four where a patch has a single element); where the elements of a
// patch disagree about another, more.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_VISIBLE_SHARE_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_VISIBLE_SHARE_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "forward/room/patches.h"
#include "forward/room/visibility.h"

namespace luxfit {

struct VisibleShares {
  Eigen::ArrayXXf share;     // the patch's elements x `partial`
  Eigen::ArrayXXf variance;  // of share
  int64_t rays = 0;
};

// `factors`: unoccluded form factors of the elements of patch p to `partial`, which say where rays matter.
VisibleShares ComputeVisibleShares(const RayScene& rays, const Patches& patches, int p,
                                   const std::vector<int>& partial, const Eigen::ArrayXXf& factors,
                                   int rays_per_element);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_VISIBLE_SHARE_H_
