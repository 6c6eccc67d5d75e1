// Corrects the photos themselves by observations of the same elements from several views.
//
// An element is diffuse: in one state its luminance is the same in every photo. Photos that disagree have
// another exposure than stated, the lens darkens towards the corners, or counts are not proportional to light
// (inverse/choose/self_calibration.h). This file translates the session, and words what was found.
#ifndef LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_LIGHT_H_
#define LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_LIGHT_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// Divides observations by the errors found in the photos' exposures, vignetting and response and by the
// gains of cameras, and adds the variance of their gains. A correction applies where calib did not fix it (no
// flat field, no response curve) and where the criterion selects it. Cameras' gains are decided before single
// photos are judged. Each is a choice ("gain of cam1") and an entry of `camera_gains`. `observations` are in
// one unit (apps/stages/linearize/camera_scale.h). Where `states_as_if` explains [states], its first explanation
// takes the place of the table. inverse/choose/calibrated_observations.h judges what is worth a warning:
//
//   exposure_metadata              a photo whose exposure is off
//   vignetting_found               vignetting that the session denies
//   response_not_linear            a response that the session denies
//   vignetting_undetermined        vignetting that is asked for and not determined
//   state_exposures_undetermined   states whose exposures nothing ties to the others'
//   camera_gain_undetermined       a camera that shares too few surfaces with the others
//   camera_scales_contradict       two cameras whose given factors the photos contradict
std::vector<Observation> WithSelfCalibration(const Session& session, const LinearizedPhotos& photos,
                                             const RegisteredSession& registered, const Patches& patches,
                                             const std::vector<StateExplanation>& states_as_if,
                                             std::vector<Observation> observations, RunContext& context,
                                             nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_LIGHT_H_
