// Finds luminaires whose given distribution or shape contradicts the data.
//
// Such a luminaire is fitted as given, and once more with both open
// (inverse/choose/internal/choose_model.h). From readings alone, the open one is a point. The given model
// is contradicted where the open one predicts the data left out better by more than two standard errors.
// The open one must also have less than half of the mean squared error. The sigmas of position and flux
// fitted with the given model are then too small.
//
// Source: the cross-validation of inverse/choose/internal/choose_model.h, with two standard errors because
// this is a warning and not a choice.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_CONTRADICTION_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_CONTRADICTION_H_

#include <vector>

#include "inverse/choose/internal/choose_model.h"

namespace luxfit {

struct Contradiction {
  int luminaire = 0;
  Luminaire better;                          // model that the data support
  double score_given = 0, score_better = 0;  // mean of min(z^2, 9) on data left out
};

// `start`: luminaires as given, at their fitted places. `open`: as for ChooseLuminaireModels; luminaires with
// distribution and shape open have nothing to contradict.
std::vector<Contradiction> FindContradictions(const Room& room, const LightData& data,
                                              const LightState& start, const std::vector<OpenChoice>& open,
                                              const std::vector<ParameterPrior>& priors);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_CONTRADICTION_H_
