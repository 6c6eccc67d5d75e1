// Finds by how much a regressor moves what two views show of the same elements.
//
//   y_i = m_p + k x_i + noise      elements i that a pair of photos p shows in one state
//
// y, x: differences, the first photo less the second. m falls out of each pair's medians of y and x. k is the slope over all
// pairs, by Tukey's biweight; its sigma is the jackknife's over views. Fewer than three views, or than 300 differences, tell none.
// Sources: Beaton and Tukey (1974) (biweight); Efron and Stein (1981) (jackknife).
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_VIEW_SLOPE_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_VIEW_SLOPE_H_

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "inverse/observe/observe.h"

namespace luxfit {

// Holds two views in one state, and the observations of each element that both show: at least thirty.
struct PhotoPair {
  int a = 0, b = 0, state = 0;
  std::vector<std::pair<size_t, size_t>> shared;  // indices: of a, of b
};

// Returns the pairs of one camera's views. `camera_of_view`: by view.
std::vector<PhotoPair> PairViews(const std::vector<Observation>& observations,
                                 const std::vector<int>& camera_of_view, int camera);

// Returns ln Y_a - ln Y_b of each element of a pair.
std::vector<double> LogRatios(const PhotoPair& pair, const std::vector<Observation>& observations);

struct ViewSlope {
  double slope = 0, sigma = 0;  // k
  int views = 0;
  double spread = 0, spread_without = 0;  // robust, of y less its median, as given and without k x
};

// `y`, `x`: of each pair, as long as its `shared`. `tolerance`: of k, at which iterations end.
std::optional<ViewSlope> SlopeOverViews(const std::vector<PhotoPair>& pairs,
                                        std::vector<std::vector<double>> y,
                                        std::vector<std::vector<double>> x, double tolerance);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_VIEW_SLOPE_H_
