// What the automatic choice of accuracy chose, for the artifacts: among what and why.
#ifndef LUXFIT_APPS_STAGES_ACCURACY_CHOICES_H_
#define LUXFIT_APPS_STAGES_ACCURACY_CHOICES_H_

#include <nlohmann/json_fwd.hpp>

#include "apps/stages/stages.h"
#include "forward/light/choose_accuracy.h"

namespace luxfit {

// As choices; a warning where the error asked for was not reached.
void RecordAccuracy(const AccuracyChoice& choice, int patches, double error_percent, RunContext& context);

// What was tried, with figures.
nlohmann::json TriedJson(const AccuracyChoice& choice);

}  // namespace luxfit

#endif  // LUXFIT_APPS_STAGES_ACCURACY_CHOICES_H_
