// Fits luminaires and reflectances to the photos and luxmeter readings of a room: luxfit's front door.
//
//   first guess -> models by left-out data -> scale -> all parameters together -> detail that data support
//
// The steps are:
// 1. a start, at places seen in photos or searched for, and several starts where places compete;
// 2. the simplest model of each luminaire that data left out support (inverse/choose);
// 3. the absolute scale;
// 4. FitLuminaires on all observations, with the interreflection solved.
// Where the fit contradicts a place that is given with a sigma, it is done again without it, and kept where it explains the light no
// worse.
// The result holds values, covariance, choices with their reasons and warnings with their remedies.
//
// Throws std::invalid_argument for inputs that do not fit together:
// - no luminaires;
// - dimming without one entry for each luminaire, or a state out of range;
// - an albedo list of another length than the room's materials;
// - neither observations nor readings to fit to.
// It does not throw where the data determine too little: `findings` and RoomFit::IsUsable say so.
#ifndef LUXFIT_INVERSE_FIT_FIT_ROOM_H_
#define LUXFIT_INVERSE_FIT_FIT_ROOM_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forward/light/room.h"
#include "inverse/choose/direct_share.h"
#include "inverse/fit/room_observations.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/study/stability_score.h"

namespace luxfit {

// Findings record in words what a fit decided and what it could not decide. A choice carries the candidates
// and the reason. A warning carries a code (docs/warnings.md), what is wrong and what would fix it.
struct Warning {
  std::string code, message, remedy;
  bool is_of_outcome =
      false;  // something that was asked for is not determined, or contradicted: no whole result
};

struct Choice {
  std::string what, chosen;
  std::vector<std::string> among;  // empty: there was no alternative
  std::string because;
};

struct Findings {
  std::vector<Warning> warnings;
  std::vector<Choice> choices;

  // Returns whether something that was asked for is not determined by the data. Some warning then says what.
  bool IsUndetermined() const;
  void AddUndetermined(Warning warning);
};

struct FitRoomOptions {
  // Observed elements used until the models are chosen. They give positions to a few millimetres.
  int max_elements_to_choose = 2000;
  // Called as a step begins, with its name ("guess", "choose", "refine", "detail", "fit") and its
  // description. The token that it returns is released as the step ends. Empty: no calls.
  std::function<std::shared_ptr<void>(const std::string& step, const std::string& words)> on_step;
  // Called after each round of a fit of all luminaires. Empty: no calls.
  std::function<void(const FitRound&)> on_round;
  // Asked before each round, from any thread, and before each search of the first guess: a text ends the fit with the
  // best state so far and says why ("its budget of 120 s is spent"). Empty: the fit runs to its end.
  std::function<std::string()> stop_reason;
};

// Says why and in which step a fit ended before it was done.
struct EarlyStop {
  std::string reason, step;
};

// Holds a luminaire whose flux is not that of its type: aged, dimmed, or of another kind.
struct DeviatingFlux {
  int luminaire = 0;
  double ratio = 1;  // to the type's flux
  double z = 0;      // of its logarithm, by the type's spread, what makers allow and its own sigma
};

// Holds luminaires that are alike but for place and flux (inverse/fit/internal/judge/type_fluxes.h).
struct LuminaireType {
  std::vector<int> luminaires;  // two and more
  double flux = 0;              // median; in lm where the fit is absolute
  double relative_spread = 0;   // robust standard deviation; NaN: too few luminaires to tell
  std::vector<DeviatingFlux> deviating;
};

// Holds a luminaire of several places that explain the light equally, of which no photo shows the right one.
struct AmbiguousPlace {
  int luminaire = 0;
  Luminaire kept;                 // as its own data alone place it; its flux may be relative
  std::vector<Luminaire> rivals;  // what explains them equally, fluxes in the same unit
};

struct RoomFit {
  LuminaireFit fit;
  LightData data;                     // data of the fit, with the views of one element merged
  std::vector<bool> luminaire_found;  // false: it has no place and gives no light
  std::vector<LuminaireType> types;
  std::vector<AmbiguousPlace> ambiguous;
  Eigen::Matrix3Xd albedo_rgb;  // by material; NaN where not estimated
  // By luminaire, relative to their mean (inverse/choose/internal/detail/colour_detail.h). Empty where all have
  // one colour.
  Eigen::Matrix3Xd tint_rgb;
  Eigen::Matrix3Xd tint_rgb_sigma;  // relative
  // By luminaire: red, green and blue of its light in the camera's own channels, in a common unit, and their relative sigmas
  // (inverse/fit/internal/light_colours.h). Empty where no neutral surface tells it.
  Eigen::Matrix3Xd light_rgb, light_rgb_sigma;
  bool absolute = false;                    // whether fluxes are in lm
  bool is_scaled_by_readings = false;       // whether nothing but readings makes them so
  std::optional<DirectShare> direct_share;  // only for fits to readings alone with free reflectances
  // Counts the rounds of all fits, those of single luminaires and of parts of the data included: the work, whatever
  // the machine.
  int rounds = 0;
  std::optional<EarlyStop> stopped;  // the fit is of the best state until then
  Findings findings;

  bool IsUsable() const { return fit.IsUsable(); }
  // Returns whether the data tell direct light from light that the walls reflect.
  bool TellsDirectLight() const { return !direct_share || direct_share->is_determined; }
};

// Fits the luminaires of `observations`. Where these are counted (luminaires_are_named is false), the fit may do with fewer: the last
// of those of which nothing is known are then missing.
RoomFit FitRoom(const Room& room, const RoomObservations& observations, const FitRoomOptions& options = {});

// The following functions read a fit as its users do: only what the data determine, with sigmas. NaN marks
// what they do not determine; a sigma of 0 marks what was held. Units: m, lx, and lm; where the fit has no
// absolute scale, fluxes are relative.

// Returns the standard deviation of a parameter in its own unit. `quantity` is used for
// ParameterKind::kLuminaire only.
double SigmaOf(const LuminaireFit& fit, ParameterKind kind, int index, LuminaireQuantity quantity = {});

// Returns the same; where the place of the luminaire is ambiguous, hypot of it and the distance to the farthest rival
// (of its coordinate, the logarithm of its flux, its aim).
double SigmaOf(const RoomFit& fit, ParameterKind kind, int index, LuminaireQuantity quantity = {});

// Returns whether the data determine the luminaire's flux in lumens, better than to a factor of e (1 sigma), and it did not
// stop at a bound. A flux whose sigma is not a number is not determined.
bool IsFluxKnown(const RoomFit& fit, size_t luminaire);

// Returns, by material, whether only indirect light tells its reflectance: it was estimated, and no photo's row of
// weight shows its surfaces.
std::vector<bool> ToldByIndirectLight(const Room& room, const RoomFit& fit);

// Returns whether every luminaire that is on in the state was found.
bool IsLit(const RoomFit& fit, int state);

// Returns the luminaires that were found. Their flux is relative where the fit is not absolute.
std::vector<EstimatedLuminaire> EstimatedLuminaires(const RoomFit& fit);

// Holds a prediction. Its sigma is hypot(sigma by the parameters, shared model error * prediction).
struct PredictedReading {
  bool is_known = false;  // false: there is no scale, or a luminaire that is on was not found
  double illuminance_lx = 0;
  Eigen::VectorXd direct_lx;  // by luminaire, as dimmed in its state
  double parameter_sigma_lx = 0;
  double sigma_lx = 0;
};
// Returns one prediction for each reading of `fit.data`; empty where nothing was fitted.
std::vector<PredictedReading> PredictedReadings(const RoomFit& fit);

struct CountLuminairesOptions {
  int max_count = 0;  // largest number tried; 0: 12, or more where photos show more
  std::string group;  // what is counted, in words; empty: all luminaires
  std::function<std::string()>
      stop_reason;  // as in FitRoomOptions; ends the count with the numbers compared so far
};

// Counts the luminaires that nobody names from one state in which all are on
// (inverse/choose/internal/choose_count.h). Returns the chosen number, at least 1, and records the choice.
// Where nothing could be placed, it sets `undetermined` and a warning says why. Throws as
// ChooseLuminaireCount does. `given.luminaires`: the luminaires that are known already.
int CountLuminaires(const Room& room, const RoomObservations& given, const CountLuminairesOptions& options,
                    Findings& findings);

// Returns what was observed in one state, and no luminaire: to count those that are on in it.
RoomObservations InOneState(RoomObservations given, int state);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_FIT_ROOM_H_
