// Gives each row of a cost table a column of its own, so that the sum of the costs is least.
//
// Shape: rows <= columns. Throws std::invalid_argument otherwise, and for costs that are not finite.
// Source: Kuhn (1955), "The Hungarian method for the assignment problem", by shortest augmenting paths, O(rows^2 columns).
#ifndef LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_LEAST_COST_H_
#define LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_LEAST_COST_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

// Returns the column of each row.
std::vector<int> LeastCostColumns(const Eigen::MatrixXd& cost);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_PHOTOS_INTERNAL_LEAST_COST_H_
