// Computes the light of a report at places: at the meter's points, over work planes, at observers' eyes.
//
// There is one column for each luminaire fully on, in lx (relative where the fit has no absolute scale). A
// factor of the columns' covariance follows from stages/fit.json. States and dimming are sums of columns.
#ifndef LUXFIT_APPS_REPORT_REPORT_PLACES_H_
#define LUXFIT_APPS_REPORT_REPORT_PLACES_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/export/fitted_room.h"
#include "apps/session/report_targets.h"
#include "apps/stages/simulate/given_session.h"
#include "forward/views/glare.h"
#include "forward/views/illuminance_plane.h"
#include "inverse/model/predicted_places.h"

namespace luxfit {

struct ReportPlane {
  TargetArea area;
  IlluminancePlane plane;
  PlaneGrid grid;
  std::vector<GridPointKind> kinds;
  Eigen::Index first_place = 0;
  // The same rectangle with `refined` times as many points a side, for lines of equal illuminance. It has
  // total_lx alone, from fewer rays (about 0.3 % of the indirect light).
  int refined = 1;
  PlaneGrid fine_grid;
  std::vector<GridPointKind> fine_kinds;
  Eigen::MatrixXd fine_lx;  // points x luminaires
};

struct ReportObserver {
  TargetObserver target;
  bool is_inside = false;            // inside a solid: no glare is computed
  std::vector<GlareSource> sources;  // by luminaire
  Eigen::Index place = 0;
};

struct ReportPlaces {
  ReadingPlaces readings;  // places 0..
  std::vector<ReportPlane> planes;
  std::vector<ReportObserver> observers;
  PredictedPlaces light;
  double relative_model_error = 0;
  std::vector<std::string> undetermined;  // parameters of the fit
};
ReportPlaces PlacesOf(const FittedRoom& fitted, const ReportTargets& targets);

// Return illuminance and the factor of its covariance for places from `first` on, under dimming.
Eigen::VectorXd IlluminanceUnder(const PredictedPlaces& light, const Eigen::VectorXd& dimming,
                                 Eigen::Index first, Eigen::Index count);
Eigen::MatrixXd FactorUnder(const PredictedPlaces& light, const Eigen::VectorXd& dimming, Eigen::Index first,
                            Eigen::Index count);

PlaneStatistics StatisticsUnder(const ReportPlaces& places, const ReportPlane& plane,
                                const Eigen::VectorXd& dimming);

// Returns the glare rating. It is NaN where it is undefined: no background light, or a luminaire that is on
// without a known luminous area.
double GlareUnder(const ReportPlaces& places, const ReportObserver& observer, const Eigen::VectorXd& dimming);

nlohmann::json PlacesJson(const FittedRoom& fitted, const ReportPlaces& places);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_PLACES_H_
