// How many luminaires the light comes from, where nobody says.
//
// For every number n a fifth of the patches (or readings) is left out, n luminaires are placed by sparse
// non-negative least squares (inverse/model/first_guess.h) and refined together as cosine-power discs of free size,
// so that a large one is not mistaken for several, and what was left out is predicted: score the mean of
// min(z^2, 9). Chosen is the smallest n whose score is within one standard error of the best (paired, facet
// by facet). Numbers are tried upwards until two in a row bring no more.
//
// All luminaires are on, dimmed alike, in every state observed.
// Throws std::invalid_argument for `max_count` below 1 or below the known places.
// Sources: Boyd, Schiebinger, Recht (2017) (see first_guess.h); Breiman et al. (1984), sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_CHOOSE_COUNT_H_
#define LUXFIT_INVERSE_CHOOSE_CHOOSE_COUNT_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "inverse/model/light_model.h"

namespace luxfit {

struct ChooseCountOptions {
  int max_count = 12;
  int max_elements = 1500;
  double start_size_m = 0.2;
  double least_share = 0.01;  // of all flux: a luminaire that gives less explains errors, not light
};

struct CountChoice {
  std::vector<int> among;
  std::vector<double> score;           // of `among`, on what was left out
  std::vector<double> standard_error;  // of its difference from the best
  int chosen = 0;                      // luminaires; 0: too little light was seen to place one
  bool reached_max = false;            // the best was the largest allowed
};

// `data` with measured indirect light, or readings alone; its dimming counts as one a state. `state` gives
// known reflectances (albedo, albedo_free). `known_positions`: of luminaires that are there for sure.
CountChoice ChooseLuminaireCount(const Room& room, const LightData& data, const LightState& state,
                                 const std::vector<std::optional<Eigen::Vector3d>>& known_positions = {},
                                 const ChooseCountOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_CHOOSE_COUNT_H_
