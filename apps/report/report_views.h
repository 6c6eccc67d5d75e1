// Compares photos of a report with what the fit predicts of them.
//
//   residual = 100 (Y / (c L) - 1) percent      Y: relative luminance of the photo, L: predicted, cd/m2
//
// c is the camera's scale of the fit; without one, it makes the median ratio of all views 1. Photos are
// corrected by what the fit found them to be off (apps/session/photo_corrections.h). Pictures are reduced to
// a common budget of pixels, and photo and prediction share one white. Luminaires, and pixels that are
// saturated or dark in the photo, have no residual.
#ifndef LUXFIT_APPS_REPORT_REPORT_VIEWS_H_
#define LUXFIT_APPS_REPORT_REPORT_VIEWS_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/export/fitted_room.h"

namespace luxfit {

// Compares the photos of registered views in every state. Returns an empty list where there are none. Throws
// as ReadLuminance does.
nlohmann::json ReportViewsJson(const FittedRoom& fitted);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_VIEWS_H_
