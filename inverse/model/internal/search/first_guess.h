// Guesses where the luminaires are, with no help from the user.
//
// 1. A state is the sum of the luminaires' light. Least squares, place by place, separates each luminaire's
//    own light. Luminaires that are always dimmed in one proportion stay one group.
// 2. With the indirect light that the photos measured (inverse/model/internal/measured_indirect.h), a
//    group's light is
//      Y_e / rho_m(e) = I_e + c / pi * sum_j Phi_j D_e(p_j),
//    linear in fluxes and 1 / rho. Sparse non-negative least squares places as many point luminaires as the
//    group has, one by one. It searches a grid through the room, with a few lobes and aims at each place
//    (inverse/model/internal/search/sparse_luminaires.h). With readings alone, the indirect light is taken as even.
// 3. Photos may show places that are bright in states of the group and in no other
//    (inverse/observe/seen_luminaires.h). They are tried first; where they suffice, nothing is searched. Where
//    they do not, those that three views or more show stay, and a search anywhere gives their rivals.
//
// Where photos show any luminaire beyond doubt (IsSure), those of three views and more would show others, too: no search puts one
// where it would shine towards these views (`views`).
//
// LightData::checkpoint ends the search: from then on only places seen in photos are tried.
//
// Fluxes are those for a camera scale of 1. Distances are in m. Luminaires of one group are interchangeable.
// They come in the order of their places (order_of_places.h); those of a known position are apart.
//
// Sources: Lawson and Hanson (1974), "Solving Least Squares Problems", ch. 23 (NNLS); Boyd, Schiebinger,
// Recht (2017), "The alternating descent conditional gradient method for sparse inverse problems".
#ifndef LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_FIRST_GUESS_H_
#define LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_FIRST_GUESS_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_state.h"
#include "inverse/observe/seen_luminaires.h"
#include "inverse/observe/watchers.h"

namespace luxfit {

struct FirstGuessOptions {
  double grid_m = 0.4;     // coarse enough to be quick, fine enough to reach the right minimum
  int refinements = 4;     // each halves the grid around the best
  int max_elements = 800;  // spread evenly over those observed
};

struct LuminaireGuess {
  bool found = false;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d aim{0, 0, -1};
  Distribution distribution = Distribution::kCosinePower;
  double cosine_exponent = 1;
  bool is_aimed = false;         // the light tells the aim, which lies along no axis of the room
  double flux = 0;               // in units of the camera scale
  double relative_residual = 0;  // rms
  // Number of places seen in photos where it may hang, and the index of the one chosen. No index: the search
  // over all places found it.
  int seen_candidates = 0;
  std::optional<int> seen;
  bool was_searched = true;  // places other than those seen were tried, too
  // Luminaires at other places that explain the light nearly as well: position, aim and lobe. Empty where
  // nothing was searched.
  std::vector<Luminaire> rivals;
};

struct FirstGuess {
  bool separable = false;  // the states tell the groups apart
  std::string message;
  std::vector<std::vector<int>> groups;  // luminaires of each group, without those that were never on
  std::vector<LuminaireGuess> luminaires;
  Eigen::VectorXd albedo;  // by material; 0.5 where no observation determines it
};

// `data`: with measured indirect light, or readings alone. `known_positions`: one for each luminaire, or
// empty. `seen`: places seen in photos, if any.
FirstGuess GuessLuminaires(const Room& room, const LightData& data,
                           const std::vector<std::optional<Eigen::Vector3d>>& known_positions = {},
                           const std::vector<SeenPlace>& seen = {}, const std::vector<Watcher>& views = {},
                           const FirstGuessOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_INTERNAL_SEARCH_FIRST_GUESS_H_
