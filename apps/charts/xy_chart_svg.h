// Draws series of points over one quantity as SVG: sweeps of a parameter, speed against accuracy.
//
// Colours and marks differ by series, so that the picture can be read without colours. Lines lie below marks,
// and labels keep clear of marks and of each other where there is room. A point that is not finite, or not
// > 0 on a logarithmic axis, is left out and interrupts its line. The legend leaves out series without points
// and series without a name.
#ifndef LUXFIT_APPS_CHARTS_XY_CHART_SVG_H_
#define LUXFIT_APPS_CHARTS_XY_CHART_SVG_H_

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/charts/svg.h"

namespace luxfit {

struct XyStyle {
  std::string colour;
  double radius_px = 4;                             // of the marks; 0: none
  std::optional<SvgMarkShape> mark = std::nullopt;  // absent: an open ring
  bool is_dashed = false;                           // the line
};

struct XySeries {
  std::string name;                             // in the legend; may have several lines; empty: not there
  std::vector<Eigen::Vector2d> points;          // (x, y)
  std::vector<std::string> labels;              // beside each point; empty: none
  bool is_joined = true;                        // a line joins the points in their order
  std::optional<XyStyle> style = std::nullopt;  // absent: by the place among the series
};

// Returns the colour and mark that a series has by its place among the series, from 0.
XyStyle XyStyleAt(std::size_t place);

struct XyAxis {
  std::string label;  // quantity and unit
  bool is_log = false;
  std::optional<double> min, max;  // absent: the range of the data, with a margin
};

struct XyChart {
  std::string title, subtitle;
  XyAxis x, y;
  std::vector<XySeries> series;
  std::vector<XySeries> keys = {};  // entries of the legend alone, above those of the series
};

// Draws the charts in one picture, one below the other. Charts in which no point can be drawn are left out;
// the text is empty where none is left.
std::string XyChartsSvg(const std::vector<XyChart>& charts);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_XY_CHART_SVG_H_
