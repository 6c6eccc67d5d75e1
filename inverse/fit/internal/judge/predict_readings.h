// Predicts the readings of a fit by its light (inverse/model/fitted_light.h).
//
//   R_rs = g_r E_r(dimming of s)     g: gain of the meter and its sensor
//
// The rows of the fit stand beside that by up to 0.1 %: they hold what bodies hide, what colours add and which
// parts of luminaires are visible where the luminaires stood a step before.
#ifndef LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_PREDICT_READINGS_H_
#define LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_PREDICT_READINGS_H_

#include "forward/light/room.h"
#include "inverse/model/fit_luminaires.h"

namespace luxfit {

// `fit`: of `data`. Returns it with `predicted` and `reading_direct_lx` of readings replaced.
LuminaireFit WithPredictedReadings(const Room& room, const LightData& data, LuminaireFit fit);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_FIT_INTERNAL_JUDGE_PREDICT_READINGS_H_
