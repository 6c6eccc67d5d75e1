// Photos of a report beside what the fit predicts of them.
//
//   residual = 100 (Y / (c L) - 1) percent      Y: relative luminance of the photo, L: predicted, cd/m2
//
// c is the camera's scale of the fit; without one, what makes the median ratio of all views 1. Photos are
// corrected by what the fit found them to be off (apps/session/photo_corrections.h). Pictures are reduced to a common
// budget of pixels; photo and prediction share one white. Pixels that the photo does not
// tell (saturated, dark) and luminaires have no residual.
#ifndef LUXFIT_APPS_REPORT_REPORT_VIEWS_H_
#define LUXFIT_APPS_REPORT_REPORT_VIEWS_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/export/fitted_room.h"

namespace luxfit {

// Percent that the colours of residuals end at.
constexpr double kResidualLimitPercent = 20;

struct ReportViewsOptions {
  int max_pixels = 1'000'000;  // of all photos together
};

// Every state's photos of registered views. Empty where there are none; throws as ReadLuminance does.
nlohmann::json ReportViewsJson(const FittedRoom& fitted, const ReportViewsOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_VIEWS_H_
