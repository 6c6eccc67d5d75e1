// Describes the light of a report at places: at the meter's points, over work planes, at observers' eyes.
//
// There is one column for each luminaire fully on, in lx (relative where the fit has no absolute scale). A
// factor of the columns' covariance follows from that of the fit. States and dimming are sums of columns.
#ifndef LUXFIT_APPS_REPORT_REPORT_PLACES_H_
#define LUXFIT_APPS_REPORT_REPORT_PLACES_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/export/fitted_room.h"
#include "apps/session/report_targets.h"
#include "inverse/model/fit_uncertainty.h"

namespace luxfit {

nlohmann::json ReportPlacesJson(const FittedRoom& fitted, const FitUncertainty& fit,
                                const ReportTargets& targets);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_PLACES_H_
