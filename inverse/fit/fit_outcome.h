// Extracts from a fit the luminaires and predicted readings that the data determine, with their sigmas.
//
//   sigma of a prediction = hypot(sigma by the parameters, relative model error * prediction)
//
// NaN marks what the data do not determine; a sigma of 0 marks what was held. Units: m, lx, and lm; where the
// fit has no absolute scale, fluxes are relative.
#ifndef LUXFIT_INVERSE_FIT_FIT_OUTCOME_H_
#define LUXFIT_INVERSE_FIT_FIT_OUTCOME_H_

#include <vector>

#include "inverse/fit/fit_room.h"
#include "inverse/study/stability_score.h"

namespace luxfit {

// Returns the standard deviation of a parameter in its own unit. `quantity` is used for
// ParameterKind::kLuminaire only.
double SigmaOf(const LuminaireFit& fit, ParameterKind kind, int index, LuminaireQuantity quantity = {});

// Returns whether the data determine the luminaire's flux in lumens.
bool IsFluxKnown(const RoomFit& fit, size_t luminaire);

// Returns the luminaires that were found. Their flux is relative where the fit is not absolute.
std::vector<EstimatedLuminaire> EstimatedLuminaires(const RoomFit& fit);

struct PredictedReading {
  bool is_known = false;  // false: there is no scale, or a luminaire that is on was not found
  double illuminance_lx = 0;
  double direct_lx = 0;
  double parameter_sigma_lx = 0;
  double sigma_lx = 0;
};
// Returns one prediction for each reading of `fit.data`; empty where nothing was fitted.
std::vector<PredictedReading> PredictedReadings(const RoomFit& fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_FIT_OUTCOME_H_
