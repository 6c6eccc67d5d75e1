// Chooses for each luminaire the simplest model that the data support.
//
// Types are taken one by one (LightState::first_of_type; a luminaire without fellows is a type), with the
// camera's scale held. The data are the states where no other luminaires are on. Where there are none, all
// states count, with the other luminaires held. One OpenChoice, that of the first, holds for a type.
// Luminaires of a type also get models of their own. These are kept where they predict left-out data better by more
// than a standard error: one switch may hold two kinds.
//
// Models, aims and their criterion are those of inverse/choose/internal/luminaire_chooser.h.
//
// OpenChoice::refinements are tried last: a table of intensities, uneven emission, heading and aim of a given
// photometry (inverse/choose/internal/refinement.h). Each is kept only where the data left out support it.
// The function does not vary a distribution, shape or aim that the caller fixed.
//
// Where LightData::checkpoint ends it, types whose choice was not done stay as they were.
//
// Source: Breiman, Friedman, Olshen, Stone (1984), "Classification and Regression Trees", sec. 3.4
// (one-standard-error rule).
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_MODEL_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_CHOOSE_MODEL_H_

#include <string>
#include <vector>

#include "inverse/choose/internal/luminaire_chooser.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// Records whether the luminaires of a type started from the places that photos show.
struct PlacesChoice {
  std::vector<int> luminaires;
  bool is_seen = false;
  double score_found = 0, score_seen = 0;  // on data left out
};

struct ModelChoice {
  LightState state;  // the chosen models at their best so far: a start for the final fit
  std::vector<LuminaireChoice> choices;
  std::vector<AimChoice> aims;
  std::vector<Refinement> refinements;  // in the order they were tried, luminaire by luminaire
  std::vector<PlacesChoice> places;
  std::string stop_reason;  // why it was ended early; empty: it was not
};

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
