// Reads a fit as its users do: luminaires and readings with their sigmas, and only what the data determine.
//
//   sigma of a prediction = hypot(sigma by the parameters, relative model error * prediction)
//
// NaN stands for what the data do not determine, 0 for the sigma of what was held. Units: m, lm (or relative where the fit
// has no absolute scale), lx.
#ifndef LUXFIT_INVERSE_FIT_FIT_OUTCOME_H_
#define LUXFIT_INVERSE_FIT_FIT_OUTCOME_H_

#include <vector>

#include "inverse/fit/fit_room.h"
#include "inverse/study/stability_score.h"

namespace luxfit {

// Standard deviation of a parameter in its own unit; `quantity` counts for ParameterKind::kLuminaire only.
double SigmaOf(const LuminaireFit& fit, ParameterKind kind, int index, LuminaireQuantity quantity = {});

// Whether the luminaire's flux is a number of lumens that the data stand behind.
bool IsFluxKnown(const RoomFit& fit, size_t luminaire);

// The luminaires that were found. Their flux is relative where the fit is not absolute.
std::vector<EstimatedLuminaire> EstimatedLuminaires(const RoomFit& fit);

struct PredictedReading {
  bool is_known =
      false;  // else the number would be made up: no scale, or a luminaire that is on was not found
  double illuminance_lx = 0;
  double direct_lx = 0;
  double parameter_sigma_lx = 0;
  double sigma_lx = 0;
};
// One a reading of `fit.data`; empty where nothing was fitted.
std::vector<PredictedReading> PredictedReadings(const RoomFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_FIT_OUTCOME_H_
