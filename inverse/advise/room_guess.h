// Guesses a room before its first photo: what advice on the first photos and readings rests on.
//
// Luminaires hang where they are known to. The others hang kGuessedGapM under the ceiling, on a grid of cells as square
// as the floor allows. As far as nothing else is known, each is a Lambertian panel that faces down. A surface that faces
// up reflects 0.2, one that faces down 0.7, any other 0.5 (a room's usual 70/50/20); a material has the mean of its area.
//
// Guessed values, and places that are known without a sigma, are not determined (advise.h): Advise takes them as unknown
// by a metre, a factor e, or 0.3 of reflectance. The covariance holds the sigmas that are known. Values of sigma 0 and known
// reflectances, shapes and sizes are no parameters. The scale of the camera is one, unless it is known.
//
// Units: m, lm, world frame. Throws std::invalid_argument for a room without facets, for no luminaires, and for a list
// of reflectances that is not by material. Source: own.
#ifndef LUXFIT_INVERSE_ADVISE_ROOM_GUESS_H_
#define LUXFIT_INVERSE_ADVISE_ROOM_GUESS_H_

#include <optional>
#include <string>
#include <vector>

#include "calib/lens/camera.h"
#include "forward/light/room.h"
#include "inverse/advise/advise.h"
#include "inverse/fit/room_observations.h"

namespace luxfit {

constexpr double kGuessedPanelM = 0.6, kGuessedFluxLm = 3000, kGuessedGapM = 0.05;
// The model's relative error, and how many times larger the variance of a fit is than its photos say: 39 for two views
// of the office and 10 for all of them (docs/advise.md).
constexpr double kGuessedModelSigma = 0.03, kGuessedInflation = 20;
constexpr double kM2PerLuminaire = 6, kGuessedFieldDeg = 65;

struct RoomKnowledge {
  std::vector<KnownLuminaire> luminaires;
  std::vector<std::optional<double>> albedo;  // by material
  bool camera_is_absolute = false;            // photos tell cd/m2
};

// One thing that was guessed, for people.
struct Assumption {
  std::string what;             // "place", "flux", "reflectance"
  std::vector<std::string> of;  // luminaires or materials
  std::string value;
};

struct RoomGuess {
  AdviceGiven given;  // without states, views and candidates
  std::vector<Assumption> assumed;
};
RoomGuess GuessRoom(const Room& room, const RoomKnowledge& known);

// Returns how many luminaires a room of that floor may have: one for every kM2PerLuminaire, 1 to `most`.
int GuessedCount(const Room& room, int most);

// Returns a phone's main lens, kGuessedFieldDeg across 4000 px, without distortion.
Camera GuessedCamera();

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_ROOM_GUESS_H_
