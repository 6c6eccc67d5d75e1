// Holds the points of `luxfit chart --fit`, and writes and reads their table, OUT/fit.csv.
#ifndef LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FIT_CHART_POINTS_H_
#define LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FIT_CHART_POINTS_H_

#include <limits>
#include <string>
#include <vector>

#include "apps/text/formats/csv_table.h"

namespace luxfit {

struct FitPoint {
  std::string factor;
  double value = 0;  // in the factor's own unit
  int patches = 0, photos = 0, luminaires = 0, observations = 0;
  double time_s = 0;                                              // processor time
  double position_mm = std::numeric_limits<double>::quiet_NaN();  // NaN: the fit does not stand
  double flux_percent = std::numeric_limits<double>::quiet_NaN();
  double lux_percent = std::numeric_limits<double>::quiet_NaN();  // NaN: no readings that only check
  bool is_usable = true;
};

std::string FitChartCsv(const std::vector<FitPoint>& points);

// Throws std::runtime_error at the line of a field that is no number.
std::vector<FitPoint> FitPointsOf(const CsvTable& table);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_FIT_CHART_POINTS_H_
