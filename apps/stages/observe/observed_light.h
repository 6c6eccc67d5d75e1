// Says in words and JSON how photos were corrected by each other (inverse/observe/camera/photo_radiometry.h).
#ifndef LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_LIGHT_H_
#define LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_LIGHT_H_

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "apps/stages/observe/photo_names.h"
#include "apps/stages/stages.h"
#include "inverse/observe/camera/photo_radiometry.h"

namespace luxfit {

// Records the choices, each camera's gain among them ("gain of cam1"), and warns of:
//
//   exposure_metadata              a photo whose exposure is off
//   vignetting_found               vignetting that the session denies
//   response_not_linear            a response that the session denies
//   vignetting_undetermined        vignetting that is asked for and not determined
//   state_exposures_undetermined   states whose exposures nothing ties to the others'
//   camera_gain_undetermined       a camera that shares too few surfaces with the others
//   camera_scales_contradict       two cameras whose given factors the photos contradict
void RecordRadiometry(const PhotoRadiometry& radiometry, const RoomPhotos& photos, const PhotoNames& names,
                      Findings& findings);

// Adds `camera_gains` and `self_calibration` where there are such.
void AddRadiometry(const PhotoRadiometry& radiometry, const LinearizedPhotos& photos, const PhotoNames& names,
                   nlohmann::json& artifact);

// Corrects observations of a session that are in one unit, and does both. Where `states_as_if` explains [states], its
// first explanation takes the place of the table.
std::vector<Observation> WithSelfCalibration(const Session& session, const LinearizedPhotos& photos,
                                             const RegisteredSession& registered, const Patches& patches,
                                             const std::vector<StateExplanation>& states_as_if,
                                             std::vector<Observation> observations, RunContext& context,
                                             nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_OBSERVE_OBSERVED_LIGHT_H_
