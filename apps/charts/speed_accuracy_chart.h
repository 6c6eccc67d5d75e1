// Describes the chart of speed against accuracy of the forward model.
//
// Time in s is x and error in percent is y, both logarithmic. Each method is a series. Points of sweeps over
// solvers and bounces are small. The Pareto front is drawn as steps, and the automatic choice is ringed. A
// dashed line shows the reference's own standard error; errors below it have no meaning.
#ifndef LUXFIT_APPS_CHARTS_SPEED_ACCURACY_CHART_H_
#define LUXFIT_APPS_CHARTS_SPEED_ACCURACY_CHART_H_

#include <string>
#include <vector>

#include "apps/charts/before_after.h"
#include "apps/charts/chart_points.h"
#include "apps/charts/xy_chart_svg.h"

namespace luxfit {

// Draws the points of an earlier chart (`before`; empty: none) below. Of them, factor, method, time, error,
// on_front and automatic are used. Without series where the chart has no points.
XyChart SpeedAccuracyChart(const Chart& chart, const std::string& title,
                           const std::vector<ChartPoint>& before = {}, const BeforeAfterNames& names = {});

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_SPEED_ACCURACY_CHART_H_
