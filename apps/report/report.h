// Makes the report of a run: OUT/report.html, one file that opens from disk without a network.
//
// The light is that of the fitted room (apps/export/fitted_room.h), with one column a luminaire, so that the
// page's sliders can recombine it. docs/report.md explains each part.
#ifndef LUXFIT_APPS_REPORT_REPORT_H_
#define LUXFIT_APPS_REPORT_REPORT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/export/fitted_room.h"

namespace luxfit {

struct ReportOptions {
  std::string targets_path;  // empty: DefaultTargets
  std::string state;         // shown first, also in the photos; empty: the brightest
  std::string command_line;
};

// Returns all data of the page. Throws std::runtime_error for targets or a state that cannot be read.
nlohmann::json ReportData(const FittedRoom& fitted, const ReportOptions& options);

// Returns the states, the statistics of the areas and the ratings of the observers by state, out of
// ReportData.
nlohmann::json ReportSummary(const nlohmann::json& data);

// Writes OUT/report.html and returns its path.
std::string WriteReport(const FittedRoom& fitted, const nlohmann::json& data);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_H_
