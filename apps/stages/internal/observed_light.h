// What observations of the same elements from several views say of the photos themselves.
//
// An element is diffuse: in one state its luminance is the same in every photo. Photos that disagree have
// another exposure than stated, the lens darkens towards the corners, or counts are not proportional to light
// (inverse/choose/self_calibration.h).
#ifndef LUXFIT_APPS_STAGES_INTERNAL_OBSERVED_LIGHT_H_
#define LUXFIT_APPS_STAGES_INTERNAL_OBSERVED_LIGHT_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// Observations divided by what the photos' exposures, vignetting and response are found to be off, where
// calib did not fix them (no flat field, no response curve) and where the criterion asks for it; variances
// enlarged by that of their photo's gain. Warns of photos whose exposure is off by more than 8 %
// ("exposure_metadata"), of vignetting and of a response that the session denies ("vignetting_found",
// "response_not_linear"), of vignetting that is asked for and not determined ("vignetting_undetermined"), and
// of states whose exposures nothing ties to the others' ("state_exposures_undetermined").
std::vector<Observation> WithSelfCalibration(const Session& session, const RegisteredSession& registered,
                                             const Patches& patches, std::vector<Observation> observations,
                                             RunContext& context, nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_OBSERVED_LIGHT_H_
