// Charts the error of the whole fit against its time: `luxfit chart SESSION -o OUT --fit`.
//
// One factor is varied at a time, the rest as in `luxfit fit`: patch size, element size, rays of the form
// factors, elements used, views, states, luminaires. Each point repeats the room, the observations and the
// fit with all steps of `luxfit fit`; photos are registered once. Bounces are not varied: the radiosity
// system is factored once, so that all bounces cost what one costs. The forward model's chart has them.
//
//   position, flux    median error over luminaires, against --truth or against the finest point
//   lux               mean error of the readings that only check, % of their mean
//   time              of the processor, over all cores: form factors and fit
//   slope             of ln time over ln size, least squares, over patches, photos and luminaires;
//                     1 is linear
//
// Writes OUT/fit.csv, OUT/fit_position.svg, OUT/fit_flux.svg, OUT/fit_lux.svg, OUT/fit_cost.svg and
// OUT/stages/fit_chart.json. Throws std::runtime_error as the stages do.
#ifndef LUXFIT_APPS_COMMANDS_STUDY_STAGE_FIT_CHART_H_
#define LUXFIT_APPS_COMMANDS_STUDY_STAGE_FIT_CHART_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/charts/before_after.h"
#include "apps/stages/stages.h"

namespace luxfit {

struct FitChartOptions {
  int elements = 1000;     // observed elements that each fit uses, except where their number is varied
  std::string truth_path;  // file of true luminaires; empty: the point with all elements counts as true
  EarlierChart before;     // drawn in the same pictures
};

nlohmann::json FitChartOfSession(const Session& session, const FitChartOptions& options, RunContext& context);
std::string FitChartTable(const nlohmann::json& artifact);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_STUDY_STAGE_FIT_CHART_H_
