// Orders places so that small errors leave the order as it is.
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_ORDER_OF_PLACES_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_ORDER_OF_PLACES_H_

#include <Eigen/Core>
#include <vector>

namespace luxfit {

// Returns the indices of places (m, world frame) in the order of x, then y, then z. Coordinates of which each lies within 0.3 m of
// the next count as equal: luminaires in a column come in the order of y, wherever noise puts their x.
std::vector<size_t> OrderOfPlaces(const std::vector<Eigen::Vector3d>& places);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_ORDER_OF_PLACES_H_
