// Where the luminaires may be, with no help from the user.
//
// 1. States are sums of luminaires' light, so where the dimming table has full column rank each luminaire's
// own light is
//    got back by least squares, element by element.
// 2. For one luminaire at a candidate place p and with a candidate distribution, the luminance of material m
// is
//      Y_e = a_m D_e(p) + b_m,   a_m, b_m >= 0
//    (direct light, and interreflection taken as even): a non-negative least squares problem of two unknowns
//    a material. (readings of a luxmeter without photos: one such line of illuminance). Places are tried on a
//    grid through the room; each distribution's best is refined by a finer grid around it.
// 3. b_m / a_m is the ratio of even indirect to direct light; the integrating sphere, E_indirect = rho / (A
// (1 - rho)) per
//    lumen, turns it into a mean reflectance, and the a_m share that out among the materials.
//
// Fluxes are such that the camera scale is 1. Distances m.
// Sources: Lawson and Hanson (1974), "Solving Least Squares Problems", ch. 23 (NNLS); Jacquez and Kuppenheim
// (1955) (sphere).
#ifndef LUXFIT_INVERSE_FIRST_GUESS_H_
#define LUXFIT_INVERSE_FIRST_GUESS_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forward/room.h"
#include "inverse/light_model.h"

namespace luxfit {

struct FirstGuessOptions {
  double grid_m = 0.4;      // coarse enough to be quick, fine enough to fall into the right valley
  int refinements = 3;      // each halves the grid around the best
  int max_elements = 1200;  // spread evenly over those observed
};

struct LuminaireGuess {
  bool found = false;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Distribution distribution = Distribution::kCosinePower;
  double cosine_exponent = 1;
  double flux = 0;               // in units of the camera scale
  double relative_residual = 0;  // rms
};

struct FirstGuess {
  bool separable = false;  // the dimming table has full column rank over the observed states
  std::string message;
  std::vector<LuminaireGuess> luminaires;
  Eigen::VectorXd albedo;  // by material; 0.5 where no observation tells
};

FirstGuess GuessLuminaires(const Room& room, const LightData& data, const FirstGuessOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIRST_GUESS_H_
