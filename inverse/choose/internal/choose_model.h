// Chooses for each luminaire the simplest model that the data support.
//
// Candidates, by number of free parameters beyond position and flux:
//   0 isotropic point, Lambertian point · 1 cosine-power point, two-sided point, Lambertian disc · 2 Lambertian
//   rectangle, cosine-power disc, two-sided disc · 3 cosine-power rectangle, two-sided rectangle; one more for a
//   rectangle with a free heading
// A two-sided luminaire is Lambertian up and down, with a free share up (forward/luminaire/luminaire_parts.h). It is
// tried where points that light one side leave more than 1 %.
// Types are taken one by one (LightState::first_of_type; a luminaire without fellows is a type), with the
// camera's scale held. The data are the states where no other luminaires are on. Where there are none, all
// states count, with the other luminaires held. One OpenChoice, that of the first, holds for a type.
// Luminaires of a type also get models of their own. These are kept where they predict left-out data better by more
// than a standard error: one switch may hold two kinds.
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
// falls on a facet or two. Differences over so few groups have no reliable standard error, and a size must also gain
// a quarter of the score.
//
// OpenChoice::refinements are tried last: a table of intensities, uneven emission, heading and aim of a given
// photometry (inverse/choose/internal/refinement.h). Each is kept only where the data left out support it.
// The function does not vary a distribution, shape or aim that the caller fixed.
//
// Source: Breiman, Friedman, Olshen, Stone (1984), "Classification and Regression Trees", sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_MODEL_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_MODEL_H_

#include <string>
#include <vector>

#include "inverse/choose/internal/refinement.h"
#include "inverse/model/fit_luminaires.h"

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

// Records whether the luminaires of a type started from the places that photos show.
struct PlacesChoice {
  std::vector<int> luminaires;
  bool is_seen = false;
  double score_found = 0, score_seen = 0;  // on data left out
};

constexpr double kStartSizeM = 0.3;  // of a disc or rectangle, until it is estimated

struct ModelChoice {
  LightState state;  // the chosen models at their best so far: a start for the final fit
  std::vector<LuminaireChoice> choices;
  std::vector<AimChoice> aims;
  std::vector<Refinement> refinements;  // in the order they were tried, luminaire by luminaire
  std::vector<PlacesChoice> places;
};

// Returns whether all sides of a disc or rectangle shrank below 1 cm: its light is that of a point.
bool HasVanished(const Luminaire& luminaire);

// Holds other places that the luminaires of a type may have: a second start.
struct TypePlaces {
  int first = 0;  // of the type
  std::vector<Eigen::Vector3d> places;
};

// `start` should be a converged fit with cosine-power points (or what is given).
// Throws std::invalid_argument unless `open` has one entry for each luminaire.
ModelChoice ChooseLuminaireModels(const Room& room, const LightData& data, const LightState& start,
                                  const std::vector<OpenChoice>& open,
                                  const std::vector<ParameterPrior>& priors = {},
                                  const std::vector<TypePlaces>& rivals = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_MODEL_H_
