// Records the automatic choice of accuracy for the artifacts: what was chosen, among what, and why.
#ifndef LUXFIT_APPS_STAGES_SIMULATE_ACCURACY_CHOICES_H_
#define LUXFIT_APPS_STAGES_SIMULATE_ACCURACY_CHOICES_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/stages.h"
#include "forward/light/choose_accuracy.h"

namespace luxfit {

// Adds the choices to the context, and a warning where the error asked for was not reached.
void RecordAccuracy(const AccuracyChoice& choice, int patches, double error_percent, RunContext& context);

// Returns the settings that were tried, with their figures.
nlohmann::json TriedJson(const AccuracyChoice& choice);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_SIMULATE_ACCURACY_CHOICES_H_
