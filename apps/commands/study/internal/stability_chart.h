// Charts success rate and error of a fit against one degradation, as SVG and as rows of a table.
#ifndef LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_STABILITY_CHART_H_
#define LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_STABILITY_CHART_H_

#include <string>
#include <vector>

#include "apps/stages/degrade/degradations.h"
#include "inverse/study/stability_score.h"

namespace luxfit {

struct LevelResult {
  double level = 0;
  LevelSummary summary;
  int undetermined = 0;                 // trials that reported so, or could not be fitted
  int warned = 0;                       // trials with a warning that the undegraded session does not have
  double median_lux_error_percent = 0;  // NaN: no readings that only check
};

struct DegradationResult {
  Degradation degradation;
  std::vector<LevelResult> levels;
};

// Draws two charts, one above the other: rates in percent, and median errors of position (mm) and flux (%).
std::string StabilitySvg(const DegradationResult& result, const std::string& session, int trials);

std::string StabilityCsv(const std::vector<DegradationResult>& results);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_STABILITY_CHART_H_
