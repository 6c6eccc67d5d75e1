// The page of a report: one HTML file that needs nothing else.
//
// Style, program (three.js among it) and data stand in it. The data are JSON in a script element that no
// browser runs: every '<', '>' and '&' of it is written as \u003c, \u003e, \u0026, so that no text of the
// user can end it.
//
// Source: HTML Living Standard, sec. 4.12.1.3 (restrictions for contents of script elements).
#ifndef LUXFIT_APPS_REPORT_REPORT_PAGE_H_
#define LUXFIT_APPS_REPORT_REPORT_PAGE_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace luxfit {

// Made by the build from apps/report/ (CMakeLists.txt).
struct ReportAssets {
  std::string_view html, css, script;
};
ReportAssets GetReportAssets();

std::string JsonForHtml(const nlohmann::json& data);

std::string ReportPage(const std::string& title, const nlohmann::json& data);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_REPORT_PAGE_H_
