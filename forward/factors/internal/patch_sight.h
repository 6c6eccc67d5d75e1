// Sight between all pairs of patches, by shaft culling down a hierarchy of patches: what holds for two groups
// holds for their members.
//
// Source: see forward/factors/internal/shaft.h.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_PATCH_SIGHT_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_PATCH_SIGHT_H_

#include <cstddef>
#include <vector>

#include "forward/factors/internal/shaft.h"
#include "forward/room/patches.h"

namespace luxfit {

class PatchSight {
 public:
  explicit PatchSight(const Patches& patches);
  Sight Between(size_t i, size_t j) const { return sight_[i * count_ + j]; }

 private:
  size_t count_;
  std::vector<Sight> sight_;  // patches x patches, symmetric
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_PATCH_SIGHT_H_
