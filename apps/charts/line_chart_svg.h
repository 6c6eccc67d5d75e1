// Draws series of points over one quantity as SVG: sweeps of a parameter, speed against accuracy.
//
// Colours and marks differ by series, so that the picture can be read without colours. A point that is not
// finite, or not > 0 on a logarithmic axis, is left out and interrupts its line.
#ifndef LUXFIT_APPS_CHARTS_LINE_CHART_SVG_H_
#define LUXFIT_APPS_CHARTS_LINE_CHART_SVG_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace luxfit {

struct LineSeries {
  std::string name;
  std::vector<Eigen::Vector2d> points;  // (x, y)
  std::vector<std::string> labels;      // beside each point; empty: none
  bool is_joined = true;                // a line joins the points in their order
};

struct LineChartAxis {
  std::string label;  // quantity and unit
  bool is_log = false;
  std::optional<double> min, max;  // absent: the range of the data, with a margin
};

struct LineChart {
  std::string title, subtitle;
  LineChartAxis x, y;
  std::vector<LineSeries> series;
};

// Returns an empty text where no point can be drawn.
std::string LineChartSvg(const LineChart& chart);

// Draws several charts in one picture, one below the other. Charts without points are left out.
std::string StackedLineChartsSvg(const std::vector<LineChart>& charts);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_LINE_CHART_SVG_H_
