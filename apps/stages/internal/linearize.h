// What the linearize stage does to a session, in its steps; stage_linearize.cc puts them together.
//
//   photo table + EXIF -> relative exposures -> brackets -> response -> corrected exposures -> vignetting
//
// Each step takes a session and returns it completed. Warnings name the photo (by its line in the table) and
// the remedy. Throws std::runtime_error for what the user must mend.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_LINEARIZE_H_
#define LUXFIT_APPS_STAGES_INTERNAL_LINEARIZE_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// Exposure times, f-numbers and ISO that the table leaves empty, from the files' metadata; where both speak
// and differ by more than a label's rounding, a warning "exposure_metadata". Throws where neither gives a
// time.
Session WithMetadata(Session session, RunContext& context);

// One photo for the rows of one view, state and camera, in the order of the first of them, with its bracket
// of relative exposures. Warns ("exposure_incomplete") where ISO or aperture is known of some photos of a
// camera.
Session WithBrackets(Session session, RunContext& context);

// The response curve of every camera that is not linear: read, or estimated from brackets and written to
// OUT/response_CAMERA.csv. `artifact` gets the scores.
Session WithResponses(Session session, RunContext& context, nlohmann::json& artifact);

// Relative exposures corrected by what overlapping pixels of a bracket show; photos that are off are named
// ("exposure_metadata").
Session WithCorrectedExposures(Session session, RunContext& context, nlohmann::json& artifact);

// Vignetting of the cameras that name a flat field.
Session WithFlatFields(Session session, RunContext& context, nlohmann::json& artifact);

// Whether no luminaire is on in a state.
bool IsAmbient(const Session& session, const SessionState& state);

// Readings without the light of the all-off state, measured at the same place; those of that state itself are
// taken out. Warns ("ambient_in_readings") of places where it was not measured.
Session WithoutAmbientReadings(Session session, RunContext& context);

// A response curve as a table: count,relative_exposure, with the columns relative_exposure_green and
// relative_exposure_blue where channels differ (the first is then red's).
CameraResponse ReadResponse(const std::string& path);
std::string ResponseCsv(const CameraResponse& response);

// "photos.csv:12 (IMG_0012.png)"
std::string PhotoName(const Session& session, const SessionExposure& exposure);

// One file as relative luminance by its camera's response, without vignetting.
LuminanceImage ReadExposure(const Session& session, size_t camera, const SessionExposure& exposure);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_LINEARIZE_H_
