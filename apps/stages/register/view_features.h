// Reconstructs a session's views from features: from the COLMAP model that the session names, or by running
// COLMAP.
//
// Throws std::runtime_error("FILE...: expected ..., got ...; remedy") where a model is malformed, shows no
// view of the session or was made of pictures of another size. Throws MissingProgram where COLMAP must run
// and is not installed.
#ifndef LUXFIT_APPS_STAGES_REGISTER_VIEW_FEATURES_H_
#define LUXFIT_APPS_STAGES_REGISTER_VIEW_FEATURES_H_

#include <string>
#include <vector>

#include "apps/stages/register/view_tags.h"
#include "calib/register/feature_model.h"

namespace luxfit {

// Reads the model that the session names. An image belongs to a view if its name is the photo's, without
// folders and with any extension, or the view's.
FeatureModel ReadFeatures(const Session& session, const LinearizedPhotos& photos,
                          const std::vector<Camera>& cameras, const ViewPhotos& views);

// Runs COLMAP, which starts from the poses that `known` has. OUT/stages/colmap is emptied first and then
// holds COLMAP's files. The result has no views where COLMAP found no model.
FeatureModel RunFeatures(const LinearizedPhotos& photos, const std::vector<Camera>& cameras,
                         const ViewPhotos& views, const std::vector<ViewDetections>& detections,
                         const Registration& known, const RunContext& context);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_REGISTER_VIEW_FEATURES_H_
