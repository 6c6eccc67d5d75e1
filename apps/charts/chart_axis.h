// Maps values to pixels along an axis of a chart, linear or logarithmic, and places its ticks.
#ifndef LUXFIT_APPS_CHARTS_CHART_AXIS_H_
#define LUXFIT_APPS_CHARTS_CHART_AXIS_H_

#include <vector>

namespace luxfit {

struct ChartAxis {
  double min = 1, max = 10;       // > 0 on a logarithmic axis; values beyond are drawn at the end
  double from_px = 0, to_px = 1;  // where min and max lie
  bool is_log = true;

  double operator()(double value) const;

  // Returns 1, 2 and 5 of each decade, or the decades alone where there are more than four. A linear axis
  // gets about six round numbers, and so does a logarithmic one where fewer than three of those lie.
  std::vector<double> Ticks() const;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_CHART_AXIS_H_
