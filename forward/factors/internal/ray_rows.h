// Form-factor rows by rays over the receivers' hemispheres.
//
// Methods with a grid fixed to the receiver (FormFactorOps::is_from_center) start at its centre, all others
// on points spread over it.
#ifndef LUXFIT_FORWARD_FACTORS_INTERNAL_RAY_ROWS_H_
#define LUXFIT_FORWARD_FACTORS_INTERNAL_RAY_ROWS_H_

#include <functional>
#include <vector>

#include "forward/factors/form_factors.h"

namespace luxfit {

struct RayTally {
  double landed = 0, escaped = 0, back = 0;  // in weight
  double scale = 1;                          // of what the others brought, for the rays that met a back
  int64_t rays = 0;

  // The bottom of a cabinet, which lies in the floor, faces out of the room: what it sees is no loss of
  // light.
  bool SeesNothing() const { return escaped > 0.999; }
};
// Mean shares over the receivers that see something, sum of rays.
RayTally Summarise(const std::vector<RayTally>& tallies);

class RayRows {
 public:
  // Throws std::invalid_argument for a method that casts no rays over a hemisphere.
  RayRows(const RayScene& rays, const Patches& patches, FormFactorMethod method, int count);

  // Calls add(patch, weight) for every ray that meets a patch; weights are still to be scaled by tally.scale.
  using HitSink = std::function<void(int, float)>;
  RayTally Cast(const Element& receiver, uint64_t index, const HitSink& add) const;
  // Adds the row of a receiver to `row` (patches), which is zero; `index` seeds its shifts.
  RayTally Cast(const Element& receiver, uint64_t index, float* row) const;

 private:
  template <typename Add>
  RayTally Trace(const Element& receiver, uint64_t index, const Add& add) const;

  const RayScene& rays_;
  const Patches& patches_;
  std::vector<int> patch_of_element_;  // apart from the elements, which are many times its size
  const FormFactorOps& ops_;
  int count_;
  std::vector<Directions> sets_;
};

// All rows.
FormFactors RayFormFactors(const RayScene& rays, const Patches& patches, FormFactorMethod method, int count);

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_FACTORS_INTERNAL_RAY_ROWS_H_
