// Charts success rate and error of a fit against one degradation, as SVG and as rows of a table.
#ifndef LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_STABILITY_CHART_H_
#define LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_STABILITY_CHART_H_

#include <string>
#include <vector>

#include "apps/charts/before_after.h"
#include "apps/stages/degrade/degradations.h"
#include "apps/text/formats/csv_table.h"
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

// One level, as OUT/stability.csv has it. A figure that no trial has is NaN.
struct StabilityRow {
  std::string degradation;
  double level = 0;
  std::string unit;
  int trials = 0;
  double success_percent = 0, confident_wrong_percent = 0, warned_percent = 0, undetermined_percent = 0,
         intervals_held_percent = 0;
  double median_position_mm = 0, median_flux_percent = 0, median_lux_percent = 0;
};

struct StabilityPicture {
  std::string session;  // its name
  int trials = 0;
  std::vector<StabilityRow> before;  // an earlier chart's, drawn below; empty: none
  BeforeAfterNames names;
};

// Draws two charts, one above the other: rates in percent, and median errors of position (mm) and flux (%).
std::string StabilitySvg(const DegradationResult& result, const StabilityPicture& picture);

std::string StabilityCsv(const std::vector<DegradationResult>& results);

// Throws std::runtime_error at the line of a field that is no number.
std::vector<StabilityRow> StabilityRowsOf(const CsvTable& table);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_INTERNAL_STABILITY_CHART_H_
