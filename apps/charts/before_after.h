// Draws an earlier chart and the present one in the same picture.
//
// A series of the earlier chart lies below that of the same name, in a lighter tone, dashed and with smaller
// marks. Only the present points are labelled. The legend opens with the names of the two charts. It names a
// series of the earlier chart only where the present one has no points of that name.
#ifndef LUXFIT_APPS_CHARTS_BEFORE_AFTER_H_
#define LUXFIT_APPS_CHARTS_BEFORE_AFTER_H_

#include <string>

#include "apps/charts/xy_chart_svg.h"

namespace luxfit {

struct BeforeAfterNames {
  std::string before = "before", after = "after";  // in the legend
};

// Names an earlier chart that a new one is drawn over.
struct EarlierChart {
  std::string path;  // its folder or table; empty: none
  BeforeAfterNames names;
};

// Draws both. Axes with limits span those of both. Returns `chart` itself where `before` has no finite point.
XyChart WithBefore(XyChart chart, const XyChart& before, const BeforeAfterNames& names);

// Returns the colour half way to white; both are "#rrggbb". Throws std::invalid_argument for other texts.
std::string LighterTone(const std::string& colour);

}  // namespace luxfit

#endif  // LUXFIT_APPS_CHARTS_BEFORE_AFTER_H_
