// Chooses the simplest model of one luminaire, or of a type, that the data support.
//
// Candidates, by number of free parameters beyond position and flux:
//   0 isotropic point, Lambertian point · 1 cosine-power point, two-sided point, Lambertian disc · 2 Lambertian
//   rectangle, cosine-power disc, two-sided disc · 3 cosine-power rectangle, two-sided rectangle; one more for a
//   rectangle with a free heading
// A two-sided luminaire is Lambertian up and down, with a free share up (forward/luminaire/luminaire_parts.h). It is
// tried where points that light one side leave more than 1 %.
//
// Every candidate is fitted until it converges and scored by cross-validation over five folds
// (inverse/choose/internal/left_out.h). The simplest candidate within one standard error of the best score is
// chosen.
//
// Aim: a cosine-power point (or the given model) is fitted with the start's aim and with a free one. The
// candidates turn only where the free aim lowers the score by more than a standard error. The aim of the
// chosen candidate stays free only where the same holds for it. Where the start's tilt is free, the search for
// places has told the aim from those along the room's axes
// (inverse/model/internal/search/sparse_luminaires.h). The aim stays free, and candidates have an exponent. A beam
// falls on few blocks of places. Differences over so few groups have no reliable standard error, and a size must also gain
// a quarter of the score.
//
// Source: Breiman, Friedman, Olshen, Stone (1984), "Classification and Regression Trees", sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_LUMINAIRE_CHOOSER_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_LUMINAIRE_CHOOSER_H_

#include <optional>
#include <string>
#include <vector>

#include "inverse/choose/internal/left_out.h"
#include "inverse/choose/internal/refinement.h"
#include "inverse/model/fit_luminaires.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {

struct ModelCandidate {
  Distribution distribution = Distribution::kLambertian;
  LuminaireShape shape = LuminaireShape::kPoint;
  bool is_turned = false;  // its heading is free
  int parameters = 0;
  std::string name;  // "lambertian rectangle"
  // It lights up and down, Lambertian on both sides, with a free share up. Its distribution is a table.
  bool is_two_sided = false;
};

struct LuminaireChoice {
  int luminaire = 0;
  std::vector<std::string> among;
  std::vector<double> score;           // one for each of `among`, on data left out
  std::vector<double> standard_error;  // standard error of the difference from the best
  int chosen = 0;                      // index into among
};

// Records whether one luminaire keeps the start's aim or gets an estimated one.
struct AimChoice {
  int luminaire = 0;
  bool is_free = false;
  double score_held = 0, score_free = 0;  // on data left out
  double standard_error = 0;              // standard error of the difference
};

// Says what the caller leaves open, one for each luminaire.
struct OpenChoice {
  bool distribution = true;
  bool shape = true;
  bool aim = true;
  bool heading = true;               // of a rectangle
  OpenRefinements refinements = {};  // none, unless a caller asks for them
};

constexpr double kStartSizeM = 0.3;  // of a disc or rectangle, until it is estimated

// Returns whether all sides of a disc or rectangle shrank below 1 cm: its light is that of a point.
bool HasVanished(const Luminaire& luminaire);

struct FittedCandidate {
  int candidate = 0;
  bool aim_is_free = false;
  FittedModel model;
};

// Returns the selection among fitted models, each with its number of parameters.
Selection SelectAmong(const SubProblem& problem, const std::vector<const FittedModel*>& models,
                      const std::vector<int>& parameters, const SelectionOptions& options = {});

// Holds the results for one luminaire.
struct ChosenModel {
  std::optional<LuminaireChoice> choice;
  std::optional<AimChoice> aim;
  std::optional<FittedCandidate> fitted;  // none where nothing is open or nothing could be left out
};

// `luminaire`: its index in the caller's room, for the record; that in the problem is SubProblem::luminaire.
ChosenModel ChooseLuminaire(const Room& room, const SubProblem& problem, int luminaire,
                            const OpenChoice& open);

// Puts a fitted model, with what it frees, into a state. `luminaires`: the indices of the model's members there.
void TakeOver(const FittedCandidate& fitted, LightState& state, const std::vector<int>& luminaires);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_LUMINAIRE_CHOOSER_H_
