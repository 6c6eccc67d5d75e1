// The simplest luminaire models that the data support.
//
// Candidates for each luminaire, by number of free parameters beyond position and flux:
//   0 isotropic point, Lambertian point · 1 cosine-power point, Lambertian disc · 2 Lambertian rectangle,
//   cosine-power disc · 3 cosine-power rectangle
// Luminaires are taken one by one, with reflectances and camera scale held at the start's values, in the
// states where the luminaire is on alone (where there are none: in all states, with the other luminaires
// held). A fifth of the patches is left out, every candidate is fitted to the rest and scored on what was
// left out: the mean of min(z^2, 9), z the residual over its own sigma and one common model error (the
// smallest that any candidate reached). Chosen is the simplest candidate whose score is within one standard
// error of the best; the standard error is that of the paired difference, facet by facet, because residuals
// of one facet are no independent evidence.
//
// Aim: a cosine-power point (or what is given) is fitted with the start's aim and with a free one. Only where
// freeing it lowers the score on what was left out by more than a standard error do the candidates turn, too,
// and only where the same holds of the chosen one does it stay free.
//
// Then what OpenChoice::refinements asks for: a table of intensities, uneven emission, heading and aim of a
// given photometry (inverse/choose/refinement.h), each kept only where what was left out asks for it.
//
// What the caller fixed (a given distribution, shape or aim) is not varied.
// Source: Breiman, Friedman, Olshen, Stone (1984), "Classification and Regression Trees", sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_CHOOSE_MODEL_H_
#define LUXFIT_INVERSE_CHOOSE_CHOOSE_MODEL_H_

#include <string>
#include <vector>

#include "inverse/choose/refinement.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

struct ModelCandidate {
  Distribution distribution = Distribution::kLambertian;
  LuminaireShape shape = LuminaireShape::kPoint;
  int parameters = 0;
  std::string name;  // "lambertian rectangle"
};

struct LuminaireChoice {
  int luminaire = 0;
  std::vector<std::string> among;
  std::vector<double> score;           // of `among`, on what was left out
  std::vector<double> standard_error;  // of its difference from the best
  int chosen = 0;                      // index into among
};

// Of one luminaire: the aim of the start, or an estimated one.
struct AimChoice {
  int luminaire = 0;
  bool is_free = false;
  double score_held = 0, score_free = 0;  // on what was left out
  double standard_error = 0;              // of their difference
};

// What the caller leaves open, one a luminaire.
struct OpenChoice {
  bool distribution = true;
  bool shape = true;
  bool aim = true;
  OpenRefinements refinements = {};  // none: a caller asks for them
};

struct ChooseModelOptions {
  int max_elements = 2500;       // observed elements used a luminaire; thinned evenly
  double start_size_m = 0.3;     // of discs and rectangles
  int max_outer_iterations = 2;  // the start is converged: visibility and weights are refreshed once
  int max_inner_iterations = 8;
  RefineOptions refine;
};

struct ModelChoice {
  LightState state;  // the chosen models at their best so far: a start for the final fit
  std::vector<LuminaireChoice> choices;
  std::vector<AimChoice> aims;
  std::vector<Refinement> refinements;  // in the order they were tried, luminaire by luminaire
};

// Whether a disc or rectangle shrank below 1 cm: its light is that of a point.
bool HasVanished(const Luminaire& luminaire);

// `start` should be a converged fit with cosine-power points (or what is given).
// Throws std::invalid_argument unless `open` has one entry a luminaire.
ModelChoice ChooseLuminaireModels(const Room& room, const LightData& data, const LightState& start,
                                  const std::vector<OpenChoice>& open,
                                  const std::vector<ParameterPrior>& priors = {},
                                  const ChooseModelOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_CHOOSE_MODEL_H_
