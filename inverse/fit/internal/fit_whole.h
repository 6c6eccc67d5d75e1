// Fits the whole problem: all luminaires with their chosen models, the reflectances, and interreflection solved.
//
// First to a part of the elements until nothing moves. There it lets photos tell squares from discs, takes out
// outlines that the fit does not explain, and takes models to their simplest: needless parameters, types that
// are alike, colour, bodies. Then to as many elements as the answer needs (FitToEnoughRows).
//
// Throws FitStopped where data.checkpoint says so. `data` then has the outlines that were left.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_FIT_WHOLE_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_FIT_WHOLE_H_

#include <functional>
#include <vector>

#include "inverse/choose/internal/choose_model.h"
#include "inverse/choose/internal/detail/enough_rows.h"
#include "inverse/choose/internal/detail/needless_parameters.h"
#include "inverse/fit/fit_room.h"

namespace luxfit {

struct WholeProblem {
  const std::vector<OpenChoice>& open;                  // by luminaire: what may be chosen
  const std::vector<HeldDirections>& held;              // by luminaire: before aims and headings were chosen
  bool has_texture = false;                             // elements depart from their materials
  int max_elements = 0;                                 // of the part
  std::function<std::vector<ParameterPrior>()> priors;  // with the outlines that `data` has then
  std::function<void(const FitRound&)> on_round;
};

struct WholeFit {
  LuminaireFit fit;
  TakenRows taken;
};

// `data`: gets the observations that were fitted and the outlines that were explained. `findings` gets what was
// chosen.
WholeFit FitWhole(const Room& room, const RoomObservations& given, const LightState& start,
                  const WholeProblem& problem, LightData& data, Findings& findings);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_FIT_WHOLE_H_
