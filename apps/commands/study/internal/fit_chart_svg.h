// Describes the pictures of `luxfit chart --fit`: errors against time, and time against size.
//
//   slope = cov(ln size, ln time) / var(ln size)          least squares over the fits that stand; 1 is linear
//
// Points of an earlier chart (`before`; empty: none) are drawn below (apps/charts/before_after.h).
#ifndef LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FIT_CHART_SVG_H_
#define LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FIT_CHART_SVG_H_

#include <map>
#include <string>
#include <vector>

#include "apps/charts/before_after.h"
#include "apps/charts/xy_chart_svg.h"
#include "apps/commands/study/internal/fit_chart_points.h"

namespace luxfit {

struct FitPicture {
  std::string file;  // name in OUT
  XyChart chart;
};
// Returns errors of positions, fluxes and readings against time, then the cost.
std::vector<FitPicture> FitPictures(const std::vector<FitPoint>& points, const std::string& session,
                                    const std::vector<FitPoint>& before = {},
                                    const BeforeAfterNames& names = {});

// Returns the slopes over patches, photos and luminaires, by these names. One is absent below two fits that
// stand, and NaN where their sizes are alike.
std::map<std::string, double> FitSlopes(const std::vector<FitPoint>& points);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FIT_CHART_SVG_H_
