// Series of points over one quantity, as SVG: sweeps of a parameter, speed against accuracy.
//
// Colours and marks differ by series, so that the picture can be read without colours. A point that is not
// finite, or not > 0 on a logarithmic axis, is left out and breaks its line.
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
  bool is_joined = true;                // by a line, in the order of the points
};

struct LineChartAxis {
  std::string label;  // quantity and unit
  bool is_log = false;
  std::optional<double> min, max;  // absent: the data's, with a little room
};

struct LineChart {
  std::string title, subtitle;
  LineChartAxis x, y;
  std::vector<LineSeries> series;
};

// Empty where no point can be drawn.
std::string LineChartSvg(const LineChart& chart);

// Several charts in one picture, each below the one before; those without points are left out.
std::string StackedLineChartsSvg(const std::vector<LineChart>& charts);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_LINE_CHART_SVG_H_
