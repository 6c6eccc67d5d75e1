// What is given of a luminaire, against what the data say of it.
//
// A luminaire whose distribution or shape is given is fitted as given, and once more with both open
// (inverse/choose/choose_model.h); from readings alone, as a point. Where the open one predicts what was left out
// better by more than three standard errors and with less than half of the mean squared error, what was given
// is contradicted: position and flux fitted with it are then not what their sigmas say. Source: the
// cross-validation of inverse/choose/choose_model.h; two standard errors because a warning is no choice.
#ifndef LUXFIT_INVERSE_CHOOSE_CONTRADICTION_H_
#define LUXFIT_INVERSE_CHOOSE_CONTRADICTION_H_

#include <string>
#include <vector>

#include "inverse/choose/choose_model.h"

namespace luxfit {

struct Contradiction {
  int luminaire = 0;
  Luminaire better;                          // as the data would have it
  double score_given = 0, score_better = 0;  // mean of min(z^2, 9) on what was left out
  double standard_error = 0;                 // of their difference
};

// `start`: luminaires as given at their fitted places; `open` as for ChooseLuminaireModels: those with
// distribution and shape open have nothing to contradict.
std::vector<Contradiction> FindContradictions(const Room& room, const LightData& data,
                                              const LightState& start, const std::vector<OpenChoice>& open,
                                              const std::vector<ParameterPrior>& priors = {},
                                              const ChooseModelOptions& options = {});

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_CONTRADICTION_H_
