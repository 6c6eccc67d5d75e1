// Declares the steps of the linearize stage; stage_linearize.cc runs them in order.
//
//   photo table + EXIF -> relative exposures -> brackets -> counts cut off -> response -> corrected exposures -> vignetting
//
// Each step takes photos and returns them completed; the session stays as it is. Warnings name the photo (by
// its line in the table) and the remedy. Throws std::runtime_error for what the user must fix.
#ifndef LUXFIT_APPS_STAGES_LINEARIZE_LINEARIZE_H_
#define LUXFIT_APPS_STAGES_LINEARIZE_LINEARIZE_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/stages/stages.h"

namespace luxfit {

// Returns the session's rows with the exposure times, f-numbers and ISO that the table leaves empty, from the
// files' metadata. Warns ("exposure_metadata") where both exist and differ by more than a label's rounding.
// Throws where neither gives a time.
std::vector<SessionPhoto> RowsWithMetadata(const Session& session, RunContext& context);

// Makes one photo of the rows of one view, state and camera, with its bracket of relative exposures, in the
// order of their first rows. Cameras are linear and without vignetting. Warns ("exposure_incomplete") where
// ISO or aperture is known for some photos of a camera only.
LinearizedPhotos MakeBrackets(const Session& session, const std::vector<SessionPhoto>& rows,
                              RunContext& context);

// Finds the counts below full scale at which photos were cut off. Warns ("counts_cut_off").
LinearizedPhotos WithCutOffs(LinearizedPhotos photos, const Session& session, RunContext& context);

// Finds the response curve of every camera that is not linear: read from its file, or estimated from brackets
// and written to OUT/response_CAMERA.csv. `artifact` receives the scores.
LinearizedPhotos WithResponses(LinearizedPhotos photos, const Session& session, RunContext& context,
                               nlohmann::json& artifact);

// Corrects relative exposures by the overlapping pixels of a bracket. Warns ("exposure_metadata") of photos
// that are off.
LinearizedPhotos WithCorrectedExposures(LinearizedPhotos photos, const Session& session, RunContext& context,
                                        nlohmann::json& artifact);

// Estimates the vignetting of cameras that name a flat field.
LinearizedPhotos WithFlatFields(LinearizedPhotos photos, RunContext& context, nlohmann::json& artifact);

// Tells whether no luminaire is on in a state.
bool IsAmbient(const Session& session, const SessionState& state);

// Returns the session's readings without the light of the all-off state, measured at the same place, and
// without the readings of that state. Warns ("ambient_in_readings") of places where it was not measured.
std::vector<LuminaireReading> ReadingsWithoutAmbient(const Session& session, RunContext& context);

// Read and write a response curve as a table: count,relative_exposure. Where channels differ, the columns
// relative_exposure_green and relative_exposure_blue follow, and the first is red's.
CameraResponse ReadResponse(const std::string& path);
std::string ResponseCsv(const CameraResponse& response);

// Returns the photo's name for messages: "photos.csv:12 (IMG_0012.png)".
std::string PhotoName(const Session& session, const PhotoExposure& exposure);
// Returns the same of the photo of a view and state; the view's name where there is none.
std::string PhotoName(const Session& session, const LinearizedPhotos& photos, const std::string& view,
                      const std::string& state);

// Reads one file as relative luminance by its camera's response; its vignetting remains.
LuminanceImage ReadExposure(const LinearizedCamera& camera, const PhotoExposure& exposure);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_LINEARIZE_LINEARIZE_H_
