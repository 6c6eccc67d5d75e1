// Where the luminaires may be, with no help from the user.
//
// 1. States are sums of luminaires' light: each luminaire's own is got back by least squares, place by place.
//    Luminaires that are always dimmed in one proportion stay one group.
// 2. With the indirect light as the photos measured it (inverse/model/measured_indirect.h), a group's light is
//      Y_e / rho_m(e) = I_e + c / pi * sum_j Phi_j D_e(p_j),
//    linear in fluxes and 1 / rho: as many point luminaires as the group has are placed one by one by sparse
//    non-negative least squares over a grid through the room, with a few lobes and aims at each place
//    (inverse/model/internal/sparse_luminaires.h). From readings alone the indirect light is taken as even.
//    Where photos show places that are bright in states of the group and in no other (inverse/
//    seen_luminaires.h), these are tried first; if they explain the light, nothing is searched.
//
// Fluxes are such that the camera scale is 1. Distances m. Luminaires of one group are interchangeable: they
// come in the order of their x (then y, then z), those of a known position apart. Sources: Lawson and Hanson
// (1974), "Solving Least Squares Problems", ch. 23 (NNLS); Boyd, Schiebinger, Recht (2017), "The alternating
// descent conditional gradient method for sparse inverse problems".
#ifndef LUXFIT_INVERSE_MODEL_FIRST_GUESS_H_
#define LUXFIT_INVERSE_MODEL_FIRST_GUESS_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "inverse/model/light_model.h"
#include "inverse/observe/seen_luminaires.h"

namespace luxfit {

struct FirstGuessOptions {
  double grid_m = 0.4;     // coarse enough to be quick, fine enough to fall into the right valley
  int refinements = 4;     // each halves the grid around the best
  int max_elements = 800;  // spread evenly over those observed
};

struct LuminaireGuess {
  bool found = false;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d aim{0, 0, -1};
  Distribution distribution = Distribution::kCosinePower;
  double cosine_exponent = 1;
  double flux = 0;               // in units of the camera scale
  double relative_residual = 0;  // rms
  // Places seen in photos where it may hang, and the index of the one where it does; none: found by the
  // search over all places.
  int seen_candidates = 0;
  std::optional<int> seen;
  bool was_searched = true;  // places other than those seen were looked at, too
  // Elsewhere, with what explains the light nearly as well: position, aim and lobe. None where it was not
  // searched.
  std::vector<Luminaire> rivals;
};

struct FirstGuess {
  bool separable = false;  // sums of states tell the groups apart
  std::string message;
  std::vector<std::vector<int>> groups;  // luminaires of each, those that were on at all
  std::vector<LuminaireGuess> luminaires;
  Eigen::VectorXd albedo;  // by material; 0.5 where no observation tells
};

// `data` with measured indirect light, or readings alone. `known_positions`: one a luminaire, or none at all;
// `seen`: places seen in photos, if any.
FirstGuess GuessLuminaires(const Room& room, const LightData& data,
                           const std::vector<std::optional<Eigen::Vector3d>>& known_positions = {},
                           const std::vector<SeenPlace>& seen = {}, const FirstGuessOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_MODEL_FIRST_GUESS_H_
