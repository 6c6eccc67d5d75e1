// Draws a chart of speed against accuracy as SVG, with one mark for each point and logarithmic axes.
//
// x is time in s, y is error in percent. Each method has a colour and a mark. The Pareto front is drawn as
// steps, and the automatic choice is ringed and labelled. A dashed line shows the reference's own standard
// error; errors below it have no meaning. Points of sweeps over solvers and bounces are drawn small.
#ifndef LUXFIT_APPS_CHARTS_CHART_SVG_H_
#define LUXFIT_APPS_CHARTS_CHART_SVG_H_

#include <string>

#include "apps/charts/chart_points.h"

namespace luxfit {

// `title` is the first line. The result is empty where there are no points.
std::string ChartSvg(const Chart& chart, const std::string& title);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_CHART_SVG_H_
