// Estimates how many luminaires give the light, where nobody states their number.
//
// For each number n, without one fold of the data in five:
// 1. Sparse non-negative least squares places n luminaires (inverse/model/internal/search/first_guess.h), first of all
//    where photos show them.
// 2. They are refined together as discs of free size, so that a large one is not mistaken for several; those that photos
//    show, with the area that they show, long ones (sides 1.5 : 1 and more) as rectangles.
// 3. They are scored on the fold left out (inverse/choose/internal/left_out.h).
// The smallest n within one standard error of the best score, or within a quarter of it, is chosen (paired, block by block): one luminaire
// more absorbs what the shapes and the mesh lack. The first number is
// that of the places that photos show beyond doubt (IsSure) and that give light. Where these are three and more that are
// alike (inverse/model/internal/search/alike_places.h) and explain the light to 5 %, that is the number. Else doubtful places that give light are
// added, and those that give least are left out, one after the other: doubtful ones that do not help by more than a standard error, sure ones as
// long as the others predict better by more than that, three and more that are alike at once. Windows and highlights are seen, too. Then
// numbers are tried upwards until two in a row bring no gain. Where photos show all of the first number beyond doubt, that is the number unless
// another leaves a tenth less of the squares.
//
// Assumes that all luminaires are on, dimmed alike, in every state observed.
// Throws std::invalid_argument for `max_count` below 0 or, where it is not 0, below the number of known places.
// Sources: Boyd, Schiebinger, Recht (2017) (see first_guess.h); Breiman et al. (1984), sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_COUNT_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_COUNT_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "inverse/model/light_state.h"
#include "inverse/observe/seen_luminaires.h"
#include "inverse/observe/watchers.h"

namespace luxfit {

struct ChooseCountOptions {
  int max_count = 0;  // 0: 12, or two more than photos show beyond doubt
  int max_elements = 1500;
  double start_size_m = 0.2;
  double least_share = 0.01;  // share of all flux: a luminaire below it explains errors, not light
};

struct CountChoice {
  std::vector<int> among;
  std::vector<double> score;           // one for each of `among`, on data left out
  std::vector<double> standard_error;  // standard error of the difference from the best
  int chosen = 0;                      // luminaires; 0: too little light was seen to place one
  bool are_shown = false;    // photos show them, alike, and their light agrees: no other number was tried
  bool are_enough = false;   // photos show them beyond doubt, and no other number leaves a tenth less
  int most = 0;              // largest number allowed
  bool reached_max = false;  // the best was that one
  std::string stopped;       // why it ended before that was known; empty: it did not
};

// `data`: with measured indirect light, or readings alone; only one dimming per state counts. `state`: gives
// known reflectances (albedo, albedo_free). LightData::checkpoint may end the count: the choice is then among the
// numbers tried so far. `known_positions`: places of luminaires that certainly exist. `places`: where luminaires
// show in photos. `views`: as GuessLuminaires has them.
CountChoice ChooseLuminaireCount(const Room& room, const LightData& data, const LightState& state,
                                 const std::vector<std::optional<Eigen::Vector3d>>& known_positions = {},
                                 const std::vector<SeenPlace>& places = {},
                                 const std::vector<Watcher>& views = {},
                                 const ChooseCountOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_COUNT_H_
