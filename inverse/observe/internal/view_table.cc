#include "inverse/observe/internal/view_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace luxfit {

ViewTable TableOfViews(const std::vector<Observation>& observations) {
  std::map<std::pair<int, int>, int> column_of;  // by element and view
  int states = 0;
  for (const Observation& o : observations) {
    if (!(o.relative_luminance > 0)) continue;
    column_of[{o.element, o.view}] = 0;
    states = std::max(states, o.state + 1);
  }
  ViewTable table;
  for (auto& [key, column] : column_of) {
    column = table.columns();
    if (table.element.empty() || table.element.back() != key.first) table.first.push_back(column);
    table.element.push_back(key.first);
    table.view.push_back(key.second);
  }
  table.first.push_back(table.columns());
  table.log_luminance =
      Eigen::ArrayXXd::Constant(states, table.columns(), std::numeric_limits<double>::quiet_NaN());
  table.variance = table.log_luminance;
  for (const Observation& o : observations) {
    if (!(o.relative_luminance > 0)) continue;
    const int column = column_of[{o.element, o.view}];
    table.log_luminance(o.state, column) = std::log(o.relative_luminance);
    table.variance(o.state, column) = o.variance / (o.relative_luminance * o.relative_luminance);
  }
  return table;
}

}  // namespace luxfit
