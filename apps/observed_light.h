// What observations of the same elements from several views say of the photos themselves.
//
// An element is diffuse: in one state its luminance is the same in every photo of a camera. Photos that
// disagree have another exposure than stated, or the lens darkens towards the corners.
#ifndef LUXFIT_APPS_OBSERVED_LIGHT_H_
#define LUXFIT_APPS_OBSERVED_LIGHT_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages.h"

namespace luxfit {

// Warns ("exposure_metadata") of photos whose luminance is off by more than 8 % against the other views of
// their state; exposures stay as they are.
void WarnOfExposures(const Session& session, const RegisteredSession& registered,
                     const std::vector<Observation>& observations, RunContext& context);

// For cameras with vignetting = "estimate": observations divided by the vignetting estimated from them, and
// by their photo's gain. Warns ("vignetting_undetermined") where they do not determine it, and leaves them.
std::vector<Observation> WithEstimatedVignetting(const Session& session, const RegisteredSession& registered,
                                                 const Patches& patches,
                                                 std::vector<Observation> observations, RunContext& context,
                                                 nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_OBSERVED_LIGHT_H_
