// Solves a bundle adjustment, and leaves out and names what disagrees with the rest.
#ifndef LUXFIT_CALIB_REGISTER_INTERNAL_LEAVE_OUT_H_
#define LUXFIT_CALIB_REGISTER_INTERNAL_LEAVE_OUT_H_

#include <vector>

#include "calib/register/internal/bundle/bundle_adjustment.h"

namespace luxfit {

// Returns the note that a tag disagrees with the photos.
RegistrationNote TagDisagrees(int id);

// Solves, leaves out points' observations, then the worst tag or view, and solves again until nothing
// disagrees.
void SolveLeavingOut(const BundleContext& context, BundleAdjustment& adjustment,
                     std::vector<RegistrationNote>& notes);

}  // namespace luxfit

#endif  // LUXFIT_CALIB_REGISTER_INTERNAL_LEAVE_OUT_H_
