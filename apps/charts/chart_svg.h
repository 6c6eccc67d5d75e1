// A chart of speed against accuracy as SVG: one mark a point, logarithmic axes.
//
// x: time in s; y: error in percent. A colour and a mark a method; the Pareto front as steps; the automatic
// choice ringed and labelled; the reference's own standard error as a dashed line, below which errors mean
// nothing. Points of sweeps over solvers and bounces are drawn small.
#ifndef LUXFIT_APPS_CHARTS_CHART_SVG_H_
#define LUXFIT_APPS_CHARTS_CHART_SVG_H_

#include <string>

#include "apps/charts/chart_points.h"

namespace luxfit {

// `title` is the first line. Empty where there are no points.
std::string ChartSvg(const Chart& chart, const std::string& title);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_CHART_SVG_H_
