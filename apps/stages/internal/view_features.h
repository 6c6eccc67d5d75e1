// A session's views as a reconstruction from features: COLMAP's model that the session names, or one that
// COLMAP is run for.
//
// Throws std::runtime_error("FILE...: expected ..., got ...; mend") where a model is malformed, shows no view
// of the session or was made of pictures of another size; MissingProgram where COLMAP has to run and is not
// there.
#ifndef LUXFIT_APPS_STAGES_INTERNAL_VIEW_FEATURES_H_
#define LUXFIT_APPS_STAGES_INTERNAL_VIEW_FEATURES_H_

#include <string>
#include <vector>

#include "apps/stages/view_tags.h"
#include "calib/register/feature_model.h"

namespace luxfit {

// An image is of a view if its name is the photo's, folders aside, with any ending, or the view's.
FeatureModel ReadFeatures(const Session& session, const std::vector<Camera>& cameras,
                          const ViewPhotos& views);

// COLMAP starts from the poses that `known` has. `folder` is emptied and holds COLMAP's files afterwards. No
// views where COLMAP found no model.
FeatureModel RunFeatures(const Session& session, const std::vector<Camera>& cameras, const ViewPhotos& views,
                         const std::vector<ViewDetections>& detections, const Registration& known,
                         const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_INTERNAL_VIEW_FEATURES_H_
