// Arranges observations as a table: one column for each element in each view, one row for each state.
#ifndef LUXFIT_INVERSE_OBSERVE_INTERNAL_VIEW_TABLE_H_
#define LUXFIT_INVERSE_OBSERVE_INTERNAL_VIEW_TABLE_H_

#include <Eigen/Core>
#include <vector>

#include "inverse/observe/observe.h"

namespace luxfit {

struct ViewTable {
  std::vector<int> element, view;  // of each column; sorted by element, then view
  std::vector<int> first;          // first column of each element, and the end
  Eigen::ArrayXXd log_luminance;   // states x columns; NaN: not observed
  Eigen::ArrayXXd variance;        // of log_luminance, by noise

  int columns() const { return static_cast<int>(element.size()); }
  int elements() const { return static_cast<int>(first.size()) - 1; }
};

// Observations without positive luminance are left out.
ViewTable TableOfViews(const std::vector<Observation>& observations);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_INTERNAL_VIEW_TABLE_H_
